// Boxes, a picture of them without shadows, and what shadows make of it.

struct Frame {
    clip_from_world: mat4x4f,
    // xyz: towards the light, or its position where w is 1.
    light: vec4f,
}

@group(0) @binding(0) var<uniform> frame: Frame;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec3f,
}

// Six faces of two triangles.
@vertex
fn draw(@builtin(vertex_index) index: u32, @location(0) centre: vec3f, @location(1) half_size: vec3f, @location(2) colour: vec3f) -> Vertex {
    let axis = index / 12u;
    let side = f32((index / 6u) % 2u) * 2.0 - 1.0;
    let corners = array(vec2f(-1.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0), vec2f(-1.0, -1.0), vec2f(1.0, 1.0), vec2f(-1.0, 1.0));
    var position = vec3f(side, corners[index % 6u]);
    var normal = vec3f(side, 0.0, 0.0);
    if axis == 1u {
        position = position.zxy;
        normal = normal.zxy;
    } else if axis == 2u {
        position = position.yzx;
        normal = normal.yzx;
    }
    let world = centre + half_size * position;
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world, normal, colour);
}

struct Surface {
    @location(0) ambient: vec4f,
    @location(1) direct: vec4f,
}

@fragment
fn surface(vertex: Vertex) -> Surface {
    let normal = normalize(vertex.normal);
    let towards = normalize(frame.light.xyz - frame.light.w * vertex.world);
    let sky = (0.22 + 0.1 * normal.y) * vec3f(0.75, 0.85, 1.0);
    let sun = max(dot(normal, towards), 0.0) * vec3f(1.0, 0.95, 0.85);
    return Surface(vec4f(sky * vertex.colour, 1.0), vec4f(sun * vertex.colour, 1.0));
}

// Centre, half size and colour of each.
@group(0) @binding(1) var<storage, read> boxes: array<array<f32, 9>>;

// Whether a box lies between a place and the light: 1, or 0.
@fragment
fn trace(vertex: Vertex) -> @location(0) vec4f {
    let origin = vertex.world + 1e-3 * normalize(vertex.normal);
    let inverse = 1.0 / (frame.light.xyz - frame.light.w * origin);
    // A lamp is at the end of the ray, a sun never.
    let end = select(1e30, 1.0, frame.light.w > 0.0);
    for (var index = 0u; index < arrayLength(&boxes); index++) {
        let box = boxes[index];
        let centre = (vec3f(box[0], box[1], box[2]) - origin) * inverse;
        let half_size = vec3f(box[3], box[4], box[5]) * abs(inverse);
        let first = centre - half_size;
        let last = centre + half_size;
        let enters = max(max(first.x, first.y), max(first.z, 0.0));
        if enters < min(min(last.x, last.y), min(last.z, end)) {
            return vec4f(1.0);
        }
    }
    return vec4f(0.0);
}

@group(0) @binding(0) var ambient: texture_2d<f32>;
@group(0) @binding(1) var direct: texture_2d<f32>;
@group(0) @binding(2) var shadow_intensity: texture_2d<f32>;
// Radiance of the air, and its transmittance.
@group(0) @binding(3) var scattering: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}

@fragment
fn light(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let visibility = 1.0 - textureLoad(shadow_intensity, pixel, 0).r;
    let surface = textureLoad(ambient, pixel, 0).rgb + visibility * textureLoad(direct, pixel, 0).rgb;
    let air = textureLoad(scattering, pixel, 0);
    return vec4f(surface * air.a + air.rgb, 1.0);
}
