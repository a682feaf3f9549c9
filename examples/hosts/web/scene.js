// The scene: a ground and boxes, as triangles with a normal and a colour per corner.

// Middle, half of the extent, turn about the vertical axis, colour.
const BOXES = [
  [[0, -0.1, 0], [30, 0.1, 30], 0, [0.5, 0.46, 0.4]],
  [[0, 1.2, 0], [0.8, 1.2, 0.8], 0.5, [0.7, 0.26, 0.16]],
  [[-2.6, 0.6, 1.4], [0.6, 0.6, 1.2], 0.2, [0.16, 0.36, 0.62]],
  [[2.4, 0.45, 1.8], [0.45, 0.45, 0.45], 0.9, [0.85, 0.6, 0.16]],
  [[-1.8, 2.4, -2.2], [0.25, 2.4, 0.25], 0.3, [0.36, 0.46, 0.28]],
  [[1.9, 2.4, -2.4], [0.25, 2.4, 0.25], 0.3, [0.36, 0.46, 0.28]],
  // A beam on the two posts, and slats above the ground.
  [[0.05, 5, -2.3], [2.4, 0.2, 0.3], 0.05, [0.5, 0.34, 0.22]],
  ...[0, 1, 2, 3, 4, 5].map((slat) => [[3.6 + 0.42 * slat, 1.6, -0.6], [0.08, 0.05, 1.6], 0, [0.75, 0.74, 0.7]]),
  // A fence.
  ...[0, 1, 2, 3, 4, 5, 6, 7].map((post) => [[-3.4 + 0.5 * post, 0.45, 3.5 + 0.06 * post], [0.05, 0.45, 0.05], 0, [0.5, 0.34, 0.22]]),
  [[-1.65, 0.75, 3.71], [1.95, 0.06, 0.03], -0.12, [0.5, 0.34, 0.22]],
];

// Floats per corner: position, normal, colour.
export const STRIDE = 4 * 9;

const SIDES = [
  [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
  ],
  [
    [-1, 0, 0],
    [0, 0, 1],
    [0, 1, 0],
  ],
  [
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 0],
  ],
  [
    [0, -1, 0],
    [1, 0, 0],
    [0, 0, 1],
  ],
  [
    [0, 0, 1],
    [1, 0, 0],
    [0, 1, 0],
  ],
  [
    [0, 0, -1],
    [0, 1, 0],
    [1, 0, 0],
  ],
];
const CORNERS = [
  [-1, -1],
  [1, -1],
  [1, 1],
  [-1, -1],
  [1, 1],
  [-1, 1],
];

/** Corners of all triangles. */
export function vertices() {
  const floats = BOXES.flatMap(([middle, half, turn, colour]) => {
    const [c, s] = [Math.cos(turn), Math.sin(turn)];
    const turned = ([x, y, z]) => [c * x + s * z, y, c * z - s * x];
    return SIDES.flatMap(([normal, u, v]) =>
      CORNERS.flatMap(([a, b]) => {
        const place = [0, 1, 2].map((axis) => half[axis] * (normal[axis] + a * u[axis] + b * v[axis]));
        return [...turned(place).map((value, axis) => value + middle[axis]), ...turned(normal), ...colour];
      }),
    );
  });
  return new Float32Array(floats);
}

/** Draws depth with `depth`, what is seen with `place` and `light`, and behind it the sky with `cover` and `sky`. */
export const SHADER = `
struct Drawn {
    clip_from_world: mat4x4f,
    // The last component: the first column of pixels that shows the other technique.
    towards_sun: vec4f,
}
@group(0) @binding(0) var<uniform> drawn: Drawn;
@group(0) @binding(1) var chosen: texture_2d<f32>;
@group(0) @binding(2) var reference: texture_2d<f32>;
// Radiance, and in alpha how much of what is behind is left. Without air it is one texel.
@group(0) @binding(3) var air: texture_2d<f32>;

struct Corner {
    @builtin(position) @invariant position: vec4f,
    @location(0) normal: vec3f,
    @location(1) colour: vec3f,
}

@vertex fn depth(@location(0) position: vec3f) -> @builtin(position) @invariant vec4f {
    return drawn.clip_from_world * vec4f(position, 1.0);
}

@vertex fn place(@location(0) position: vec3f, @location(1) normal: vec3f, @location(2) colour: vec3f) -> Corner {
    return Corner(drawn.clip_from_world * vec4f(position, 1.0), normal, colour);
}

@vertex fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(select(-1.0, 3.0, index == 1u), select(-1.0, 3.0, index == 2u), 0.0, 1.0);
}

// As a screen wants it.
fn shown(colour: vec3f, pixel: vec2u) -> vec4f {
    let seen = textureLoad(air, min(pixel, textureDimensions(air) - 1u), 0);
    // The air that takes light from a surface gives some of the sky's.
    let linear = clamp(colour * seen.w + seen.xyz + (1.0 - seen.w) * vec3f(0.07, 0.09, 0.12), vec3f(0.0), vec3f(1.0));
    return vec4f(select(1.055 * pow(linear, vec3f(1.0 / 2.4)) - 0.055, 12.92 * linear, linear <= vec3f(0.0031308)), 1.0);
}

@fragment fn light(corner: Corner) -> @location(0) vec4f {
    let pixel = vec2u(corner.position.xy);
    var shadow = textureLoad(chosen, pixel, 0).x;
    if corner.position.x >= drawn.towards_sun.w {
        shadow = textureLoad(reference, pixel, 0).x;
    }
    let normal = normalize(corner.normal);
    let sun = max(dot(normal, drawn.towards_sun.xyz), 0.0) * (1.0 - shadow);
    let sky = 0.22 + 0.12 * normal.y;
    return shown(corner.colour * (1.5 * sun * vec3f(1.0, 0.95, 0.85) + sky * vec3f(0.75, 0.85, 1.0)), pixel);
}

@fragment fn sky(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return shown(vec3f(0.3, 0.45, 0.68), vec2u(position.xy));
}`;
