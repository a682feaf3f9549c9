import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::shade::leak_reduction::{leak_reduction_full_shadow};
import moment_shadows::map::map_lookup::{map_lookup_gradient};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_depth_variance, minification_footprint};
import moment_shadows::map::storage::{STORAGE_FLOAT16};
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth_minified, receiver_bias_plane, receiver_bias_step};
import moment_shadows::shade::view_border::{view_border_depth, view_border_parts};

// A forward renderer's own shader: boxes, lit by a sun whose filtered map it samples itself, with mip levels and cascades that blend.

struct Frame {
    clip_from_world: mat4x4f,
    // xyz: towards the light.
    light: vec4f,
    // From the finest to the coarsest.
    cascades: array<Cascade, 4>,
}

struct Cascade {
    light_clip_from_world: mat4x4f,
    // Gives the moment depth of a scene position (x, y, z, 1).
    moment_depth: vec4f,
    receiver_bias: ReceiverBias,
    region: MapRegion,
    // Texels of the guard band, and of the border within it.
    guard: f32,
    border: f32,
    // 1 where shadows fade out along the border.
    fades: u32,
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

// A scene position as the light sees it: x and y in a cascade's region from 0 to 1, z in moment depth.
fn place_in_region(cascade: u32, world: vec3f) -> vec3f {
    let clip = frame.cascades[cascade].light_clip_from_world * vec4f(world, 1.0);
    return vec3f(vec2f(0.5, -0.5) * clip.xy + 0.5, dot(frame.cascades[cascade].moment_depth, vec4f(world, 1.0)));
}

// Of one cascade. `difference_x` and `difference_y`: how the place changes to the next pixel, in texels and moment depth.
fn cascade_shadow_intensity(cascade: u32, place: vec3f, difference_x: vec3f, difference_y: vec3f) -> f32 {
    let gradient = receiver_bias_plane(difference_x, difference_y);
    let footprint = minification_footprint(difference_x.xy, difference_y.xy, ANISOTROPY);
    let variance = minification_depth_variance(footprint, gradient);
    let receiver_bias = frame.cascades[cascade].receiver_bias;
    let bias = receiver_bias_step(receiver_bias, place.z) + receiver_bias_depth_minified(receiver_bias, length(gradient), variance);
    let texel = map_lookup_gradient(
        shadow_map,
        shadow_sampler,
        0u,
        frame.cascades[cascade].region,
        textureNumLevels(shadow_map),
        place.xy,
        difference_x.xy,
        difference_y.xy,
        ANISOTROPY,
    );
    let intensity = hamburger4_shadow_intensity_of_texel(texel, place.z - bias, STORAGE_FLOAT16);
    return leak_reduction_full_shadow(intensity, 0.98);
}

// `step_x` and `step_y`: from the scene position to that of the next pixel.
fn shadow_intensity(world: vec3f, step_x: vec3f, step_y: vec3f) -> f32 {
    // What the cascades before have left of a place, and what was taken of it.
    var left = 1.0;
    var taken = 0.0;
    var intensity = 0.0;
    for (var cascade = 0u; cascade < 4u && left > 0.0; cascade++) {
        let extent = vec2f(frame.cascades[cascade].region.extent);
        let place = place_in_region(cascade, world);
        let inside = view_border_depth(place.xy, extent, frame.cascades[cascade].guard, false);
        if inside < 0.0 {
            continue;
        }
        let texels = vec3f(extent, 1.0);
        let difference_x = (place_in_region(cascade, world + step_x) - place) * texels;
        let difference_y = (place_in_region(cascade, world + step_y) - place) * texels;
        let parts = view_border_parts(inside, frame.cascades[cascade].border, frame.cascades[cascade].fades == 1u);
        intensity += left * parts.y * cascade_shadow_intensity(cascade, place, difference_x, difference_y);
        taken += left * parts.x;
        left -= left * parts.x;
    }
    return intensity / max(taken, 1e-30);
}

@fragment
fn lit(vertex: Vertex) -> @location(0) vec4f {
    // Derivatives need uniform control flow, so they come first.
    let step_x = dpdx(vertex.world);
    let step_y = dpdy(vertex.world);
    let normal = normalize(vertex.normal);
    let cosine = dot(normal, frame.light.xyz);
    let sun = max(cosine, 0.0) * (1.0 - shadow_intensity(vertex.world, step_x, step_y));
    let sky = 0.25 + 0.1 * normal.y;
    return vec4f(vertex.colour * (sun * vec3f(1.0, 0.95, 0.85) + sky * vec3f(0.75, 0.85, 1.0)), 1.0);
}
