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

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers the target: (-1, -1), (3, -1), (-1, 3).
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(4.0 * corner - 1.0, 0.0, 1.0);
}

// A pixel's surface as the light sees it: x and y in texels of the map, z in moment depth, w positive in front of the
// light.
fn light_space(pixel: vec2i, stored_depth: f32) -> vec4f {
    let uv = (vec2f(pixel) + 0.5) / vec2f(textureDimensions(camera_depth));
    let clip = vec4f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, stored_depth, 1.0);
    let light = parameters.light_from_camera * clip;
    let scene_w = dot(parameters.scene_w_from_camera, clip);
    // Both divisors are positive in front of the camera and the light; the results elsewhere are not used.
    let place = light.xy / max(light.z, 1e-30) * map_size();
    return vec4f(place, light.w / max(abs(scene_w), 1e-30), light.z);
}

// The difference in light space to the neighbour along `axis`, on the side where the depth changes less: the other may
// lie beyond a silhouette. On a plane both sides agree, since stored depth is linear on the screen there.
fn light_space_difference(pixel: vec2i, axis: vec2i, stored_depth: f32, centre: vec4f) -> vec3f {
    let last = vec2i(textureDimensions(camera_depth)) - 1;
    let before = pixel - axis;
    let after = pixel + axis;
    let depth_before = textureLoad(camera_depth, max(before, vec2i(0)), 0);
    let depth_after = textureLoad(camera_depth, min(after, last), 0);
    let use_before = all(before >= vec2i(0))
        && (any(after > last) || abs(depth_before - stored_depth) < abs(depth_after - stored_depth));
    if use_before {
        return centre.xyz - light_space(before, depth_before).xyz;
    }
    return light_space(after, depth_after).xyz - centre.xyz;
}

@fragment
fn shade(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let stored_depth = textureLoad(camera_depth, pixel, 0);
    if stored_depth == parameters.far_depth {
        return vec4f(0.0);
    }
    let light = light_space(pixel, stored_depth);
    let uv = light.xy / map_size();
    // Outside its map a light casts no shadow.
    if light.w <= 0.0 || any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) {
        return vec4f(0.0);
    }
    let gradient = receiver_bias_gradient(
        light_space_difference(pixel, vec2i(1, 0), stored_depth, light),
        light_space_difference(pixel, vec2i(0, 1), stored_depth, light),
    );
    let fragment_depth = light.z - receiver_bias_depth(parameters.receiver_bias, gradient);
    let moments = moments_from_texel(map_lookup(uv, parameters.layer), STORAGE);
    let intensity = hamburger_shadow_intensity(moments, fragment_depth, moments_bias_of(STORAGE));
    return vec4f(leak_reduction_apply(intensity, parameters.leak_reduction), 0.0, 0.0, 1.0);
}
