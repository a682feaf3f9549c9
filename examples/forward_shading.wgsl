import moment_shadows::hamburger::{hamburger_shadow_intensity_of_texel};
import moment_shadows::leak_reduction::{leak_reduction_full_shadow};
import moment_shadows::moments::{MOMENTS_STORAGE_FLOAT16};
import moment_shadows::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_gradient_from_cosine};

// A forward renderer's own shader: a floor with boxes on it, lit by a sun whose filtered map it samples itself.

struct Frame {
    clip_from_world: mat4x4f,
    light_clip_from_world: mat4x4f,
    // Gives the moment depth of a scene position (x, y, z, 1).
    moment_depth: vec4f,
    // xyz: towards the light; w: moment depth of a texel's width.
    light: vec4f,
    receiver_bias: ReceiverBias,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var shadow_map: texture_2d<f32>;
@group(1) @binding(1) var shadow_sampler: sampler;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec3f,
}

// Six faces of two triangles. Instance 0 is the floor, the others are boxes in a ring.
fn box_vertex(index: u32, instance: u32) -> Vertex {
    let axis = index / 12u;
    let side = f32((index / 6u) % 2u) * 2.0 - 1.0;
    let corners = array(vec2f(-1.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0), vec2f(-1.0, -1.0), vec2f(1.0, 1.0), vec2f(-1.0, 1.0));
    let corner = corners[index % 6u];
    var position = vec3f(side, corner);
    var normal = vec3f(side, 0.0, 0.0);
    if axis == 1u {
        position = position.zxy;
        normal = normal.zxy;
    } else if axis == 2u {
        position = position.yzx;
        normal = normal.yzx;
    }
    let angle = f32(instance) * 0.7;
    let height = 0.15 + 0.07 * f32(instance);
    var size = vec3f(0.18, height, 0.18);
    var centre = vec3f(1.5 * cos(angle), height, 1.5 * sin(angle));
    var colour = 0.55 + 0.3 * vec3f(cos(angle), cos(angle + 2.1), cos(angle + 4.2));
    if instance == 0u {
        size = vec3f(6.0, 0.1, 6.0);
        centre = vec3f(0.0, -0.1, 0.0);
        colour = vec3f(0.6);
    }
    let world = centre + size * position;
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world, normal, colour);
}

@vertex
fn light_depth(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> @builtin(position) vec4f {
    return frame.light_clip_from_world * vec4f(box_vertex(index, instance).world, 1.0);
}

@vertex
fn scene(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Vertex {
    return box_vertex(index, instance);
}

fn shadow_intensity(world: vec3f, cosine: f32) -> f32 {
    let clip = frame.light_clip_from_world * vec4f(world, 1.0);
    let uv = vec2f(0.5, -0.5) * clip.xy + 0.5;
    if any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) {
        return 0.0;
    }
    let gradient = receiver_bias_gradient_from_cosine(cosine, frame.light.w);
    let fragment_depth = dot(frame.moment_depth, vec4f(world, 1.0)) - receiver_bias_depth(frame.receiver_bias, gradient);
    let texel = textureSampleLevel(shadow_map, shadow_sampler, uv, 0.0);
    let intensity = hamburger_shadow_intensity_of_texel(texel, fragment_depth, MOMENTS_STORAGE_FLOAT16);
    return leak_reduction_full_shadow(intensity, 0.98);
}

@fragment
fn lit(vertex: Vertex) -> @location(0) vec4f {
    let normal = normalize(vertex.normal);
    let cosine = dot(normal, frame.light.xyz);
    let sun = max(cosine, 0.0) * (1.0 - shadow_intensity(vertex.world, cosine));
    let sky = 0.25 + 0.1 * normal.y;
    return vec4f(vertex.colour * (sun * vec3f(1.0, 0.95, 0.85) + sky * vec3f(0.75, 0.85, 1.0)), 1.0);
}
