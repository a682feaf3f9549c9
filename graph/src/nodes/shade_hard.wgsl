import moment_shadows::hamburger::{hamburger_shadow_intensity};
import moment_shadows::leak_reduction::{LeakReduction, leak_reduction_apply};
import moment_shadows::map_lookup::{map_lookup, map_size};
import moment_shadows::moments::{moments_bias_of, moments_from_texel};
import moment_shadows::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_gradient};
import moment_shadows::specialization::{GROUP, STORAGE};

// Shadow intensity of every pixel, from the camera's depth and a map of moments: one light, one layer.

struct ShadeHardParameters {
    // From the camera's clip space (x, y, stored depth, 1) to the light: x and y are the place in the map in [0, 1], z its
    // homogeneous coordinate (positive in front of the light) and w the moment depth, all times the factors they are
    // divided by. Camera and light are combined in one matrix so that no large scene coordinates occur.
    light_from_camera: mat4x4f,
    // The homogeneous coordinate of the scene position, which divides the moment depth.
    scene_w_from_camera: vec4f,
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // The stored depth of pixels that show no surface.
    far_depth: f32,
    // The map's layer.
    layer: u32,
    padding: vec2f,
}

@group(GROUP) @binding(0) var<uniform> parameters: ShadeHardParameters;
@group(GROUP) @binding(1) var camera_depth: texture_depth_2d;

struct Covered {
    @builtin(position) position: vec4f,
    // The place in the picture from 0 to 1. Other than `position` it does not depend on where in its target a host has the
    // viewport.
    @location(0) uv: vec2f,
}

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> Covered {
    // One triangle that covers the viewport: (-1, -1), (3, -1), (-1, 3).
    let corner = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    return Covered(vec4f(corner, 0.0, 1.0), 0.5 + vec2f(0.5, -0.5) * corner);
}

// A pixel's surface as the light sees it.
struct Receiver {
    // x and y in the map from 0 to 1, z in moment depth.
    place: vec3f,
    // What x and y were divided by; positive in front of the light.
    light_w: f32,
    // What z was divided by; positive in front of the camera.
    scene_w: f32,
}

fn receiver_at(pixel: vec2i, stored_depth: f32) -> Receiver {
    let uv = (vec2f(pixel) + 0.5) / vec2f(textureDimensions(camera_depth));
    let clip = vec4f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, stored_depth, 1.0);
    let light = parameters.light_from_camera * clip;
    // Results behind the camera or the light are not used.
    let scene_w = max(dot(parameters.scene_w_from_camera, clip), 1e-30);
    return Receiver(vec3f(light.xy / max(light.z, 1e-30), light.w / scene_w), light.z, scene_w);
}

fn camera_depth_at(pixel: vec2i) -> f32 {
    return textureLoad(camera_depth, clamp(pixel, vec2i(0), vec2i(textureDimensions(camera_depth)) - 1), 0);
}

// By how much the two pixels next to `pixel` along `step`, extrapolated, miss its stored depth; huge if the first one
// shows no surface or lies outside of the picture.
fn extrapolation_error(pixel: vec2i, step: vec2i, stored_depth: f32) -> f32 {
    let neighbour = pixel + step;
    let outside = any(neighbour < vec2i(0)) || any(neighbour >= vec2i(textureDimensions(camera_depth)));
    let depth = camera_depth_at(neighbour);
    let error = abs(2.0 * depth - camera_depth_at(neighbour + step) - stored_depth);
    return select(error, UNUSABLE, outside || depth == parameters.far_depth);
}

// Above every difference of stored depths.
const UNUSABLE: f32 = 1e30;

// No place in the map is that many texels away. Products of two differences must not overflow.
const LARGEST_DIFFERENCE: f32 = 1e9;

// How the place in the map (in texels) and the moment depth change from a pixel to its neighbour along `axis`, on the
// side that continues its surface: stored depth is linear on the screen where a surface is plane, so that is the side
// which extrapolates to the pixel best. The other one may lie beyond a silhouette or an edge. Zero if there is no
// neighbour, as on a surface that is edge-on to the light.
fn receiver_difference(pixel: vec2i, axis: vec2i, stored_depth: f32, receiver: Receiver) -> vec3f {
    let error_before = extrapolation_error(pixel, -axis, stored_depth);
    let error_after = extrapolation_error(pixel, axis, stored_depth);
    if min(error_before, error_after) == UNUSABLE {
        return vec3f(0.0);
    }
    let direction = select(axis, -axis, error_before < error_after);
    let across_screen = vec2f(2.0, -2.0) * vec2f(direction) / vec2f(textureDimensions(camera_depth));
    let step = vec4f(across_screen, camera_depth_at(pixel + direction) - stored_depth, 0.0);
    // With numerators n and divisors w, n1 / w1 - n0 / w0 = (dn - (n0 / w0) dw) / w1. Other than the difference of two
    // places, this keeps its digits where a pixel covers a small part of a texel.
    let light = parameters.light_from_camera * step;
    let scene_w = dot(parameters.scene_w_from_camera, step);
    let across = (light.xy - receiver.place.xy * light.z) / max(receiver.light_w + light.z, 1e-30);
    let along = (light.w - receiver.place.z * scene_w) / max(receiver.scene_w + scene_w, 1e-30);
    return clamp(vec3f(across * map_size(), along), vec3f(-LARGEST_DIFFERENCE), vec3f(LARGEST_DIFFERENCE));
}

@fragment
fn shade(@location(0) uv_of_pixel: vec2f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(camera_depth));
    let pixel = clamp(vec2i(uv_of_pixel * vec2f(size)), vec2i(0), size - 1);
    let stored_depth = textureLoad(camera_depth, pixel, 0);
    if stored_depth == parameters.far_depth {
        return vec4f(0.0);
    }
    let receiver = receiver_at(pixel, stored_depth);
    let uv = receiver.place.xy;
    // Outside its map a light casts no shadow.
    if receiver.light_w <= 0.0 || any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) {
        return vec4f(0.0);
    }
    let gradient = receiver_bias_gradient(
        receiver_difference(pixel, vec2i(1, 0), stored_depth, receiver),
        receiver_difference(pixel, vec2i(0, 1), stored_depth, receiver),
    );
    // The map holds a surface that leaves the light's range at the far end. The bias counts from there, since some of the
    // kernel may still see the surface within the range.
    let fragment_depth = min(receiver.place.z, 1.0) - receiver_bias_depth(parameters.receiver_bias, gradient);
    let moments = moments_from_texel(map_lookup(uv, parameters.layer), STORAGE);
    let intensity = hamburger_shadow_intensity(moments, fragment_depth, moments_bias_of(STORAGE));
    // In all channels, so that a host can blend with it or show it.
    return vec4f(leak_reduction_apply(intensity, parameters.leak_reduction));
}
