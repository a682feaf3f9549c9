// The picture: one light, dimmed by a shadow intensity, and light from all around.

struct Lighting {
    // Columns take normalised device coordinates to directions in world space.
    direction_from_ndc: mat4x4f,
    // w = 0: unit vector towards a directional light. w = 1: position of a spot light.
    light: vec4f,
    // Unit vector along which a spot light shines, and the cosine of half its angle.
    cone: vec4f,
    colour: vec4f,
    // Light from above and, thrown back by the ground, from below.
    sky: vec4f,
    ground: vec4f,
    // The horizon's colour; w: the distance from the origin at which the ground begins to fade into it.
    horizon: vec4f,
    zenith: vec4f,
}

@group(0) @binding(0) var<uniform> lighting: Lighting;
@group(0) @binding(1) var position_texture: texture_2d<f32>;
@group(0) @binding(2) var normal_texture: texture_2d<f32>;
@group(0) @binding(3) var base_colour_texture: texture_2d<f32>;
@group(0) @binding(4) var shadow_texture: texture_2d<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u)) * 4.0 - 1.0;
    return vec4f(corner, 0.0, 1.0);
}

@fragment
fn shade(@builtin(position) pixel: vec4f) -> @location(0) vec4f {
    let at = vec2u(pixel.xy);
    let position = textureLoad(position_texture, at, 0);
    let background = background_colour(pixel.xy);
    if position.w == 0.0 {
        return vec4f(tone_mapped(background), 1.0);
    }
    let geometric = textureLoad(normal_texture, at, 0).xyz;
    let shading = unpacked_direction(position.w - 1.0);
    let base_colour = textureLoad(base_colour_texture, at, 0).rgb;
    let shadow = clamp(textureLoad(shadow_texture, at, 0).r, 0.0, 1.0);

    let towards = normalize(lighting.light.xyz - lighting.light.w * position.xyz);
    var facing = max(dot(shading, towards), 0.0);
    // A smooth normal must not light a triangle that turns away.
    facing *= smoothstep(-0.02, 0.06, dot(geometric, towards));
    var lit = facing * (1.0 - shadow);
    if lighting.light.w > 0.0 {
        let cosine = dot(-towards, lighting.cone.xyz);
        lit *= smoothstep(lighting.cone.w, mix(lighting.cone.w, 1.0, 0.15), cosine);
    }
    let above = 0.5 + 0.5 * shading.y;
    // The half of the sky with the light in it is the brighter one; without that, what lies in shadow has no form.
    let brighter = dot(shading, normalize(towards + vec3f(0.0, 1.0, 0.0)));
    let ambient = mix(lighting.ground.rgb, lighting.sky.rgb, above) * (0.85 + 0.3 * brighter);
    let colour = base_colour * (lit * lighting.colour.rgb + ambient);
    let start = lighting.horizon.w;
    let fade = smoothstep(start, 3.0 * start, length(position.xz));
    return vec4f(tone_mapped(mix(colour, background, fade)), 1.0);
}

// Brightest at the horizon, the same below it, so that a far ground fades into it without an edge.
fn background_colour(pixel: vec2f) -> vec3f {
    let size = vec2f(textureDimensions(position_texture));
    let ndc = vec2f(2.0, -2.0) * pixel / size + vec2f(-1.0, 1.0);
    let direction = normalize((lighting.direction_from_ndc * vec4f(ndc, 1.0, 0.0)).xyz);
    return mix(lighting.horizon.rgb, lighting.zenith.rgb, smoothstep(0.0, 0.6, direction.y));
}

// Nearly linear up to the middle greys, and a soft shoulder up to white.
fn tone_mapped(colour: vec3f) -> vec3f {
    return colour * (1.0 + colour / 6.0) / (1.0 + 0.75 * colour);
}

// The inverse of packed_direction in geometry.wgsl.
fn unpacked_direction(whole: f32) -> vec3f {
    let x = floor(whole / 4096.0);
    let folded = vec2f(x, whole - 4096.0 * x) / 2047.0 - 1.0;
    var direction = vec3f(folded, 1.0 - abs(folded.x) - abs(folded.y));
    if direction.z < 0.0 {
        let unfolded = (1.0 - abs(folded.yx)) * select(vec2f(-1.0), vec2f(1.0), folded >= vec2f(0.0));
        direction = vec3f(unfolded, direction.z);
    }
    return normalize(direction);
}
