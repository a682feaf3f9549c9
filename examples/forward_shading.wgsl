import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::shade::leak_reduction::{leak_reduction_full_shadow};
import moment_shadows::map::map_lookup::{map_lookup_gradient};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_depth_variance, minification_footprint};
import moment_shadows::map::storage::{STORAGE_FLOAT16};
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth_minified, receiver_bias_plane, receiver_bias_step};

// A forward renderer's own shader: boxes, lit by a sun whose filtered map it samples itself, with mip levels.

struct Frame {
    clip_from_world: mat4x4f,
    light_clip_from_world: mat4x4f,
    // Gives the moment depth of a scene position (x, y, z, 1).
    moment_depth: vec4f,
    // xyz: towards the light.
    light: vec4f,
    receiver_bias: ReceiverBias,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(1) @binding(0) var shadow_map: texture_2d_array<f32>;
@group(1) @binding(1) var shadow_sampler: sampler;

// Probes of an anisotropic lookup, at most.
const ANISOTROPY = 8.0;

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

// A scene position as the light sees it: x and y in its map from 0 to 1, z in moment depth.
fn place_in_map(world: vec3f) -> vec3f {
    let clip = frame.light_clip_from_world * vec4f(world, 1.0);
    return vec3f(vec2f(0.5, -0.5) * clip.xy + 0.5, dot(frame.moment_depth, vec4f(world, 1.0)));
}

// `difference_x` and `difference_y`: how the place changes to the next pixel, in texels and moment depth.
fn shadow_intensity(place: vec3f, difference_x: vec3f, difference_y: vec3f) -> f32 {
    if any(place.xy < vec2f(0.0)) || any(place.xy > vec2f(1.0)) {
        return 0.0;
    }
    let gradient = receiver_bias_plane(difference_x, difference_y);
    let footprint = minification_footprint(difference_x.xy, difference_y.xy, ANISOTROPY);
    let variance = minification_depth_variance(footprint, gradient);
    let step = receiver_bias_step(frame.receiver_bias, place.z);
    let bias = step + receiver_bias_depth_minified(frame.receiver_bias, length(gradient), variance);
    let whole = MapRegion(vec2u(0u), textureDimensions(shadow_map));
    let texel = map_lookup_gradient(
        shadow_map,
        shadow_sampler,
        0u,
        whole,
        textureNumLevels(shadow_map),
        place.xy,
        difference_x.xy,
        difference_y.xy,
        ANISOTROPY,
    );
    let intensity = hamburger4_shadow_intensity_of_texel(texel, place.z - bias, STORAGE_FLOAT16);
    return leak_reduction_full_shadow(intensity, 0.98);
}

@fragment
fn lit(vertex: Vertex) -> @location(0) vec4f {
    // Derivatives need uniform control flow, so they come first.
    let place = place_in_map(vertex.world);
    let texels = vec3f(vec2f(textureDimensions(shadow_map)), 1.0);
    let difference_x = dpdx(place) * texels;
    let difference_y = dpdy(place) * texels;
    let normal = normalize(vertex.normal);
    let cosine = dot(normal, frame.light.xyz);
    let sun = max(cosine, 0.0) * (1.0 - shadow_intensity(place, difference_x, difference_y));
    let sky = 0.25 + 0.1 * normal.y;
    return vec4f(vertex.colour * (sun * vec3f(1.0, 0.95, 0.85) + sky * vec3f(0.75, 0.85, 1.0)), 1.0);
}
