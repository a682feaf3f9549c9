import moment_shadows::air::upsample::{upsample_weight};
import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel, camera_depth_pixel_around, camera_depth_size};
import node::fullscreen::{Covered};
import node::specialization::{GROUP, PER_TEXEL};

// Scattered light at all pixels, from that of every so many: the mean of the four nearest that saw what lies as far away.

struct UpsampleScatteringParameters {
    // The homogeneous coordinate of the scene position, and its value at the far end.
    scene_w_from_camera: vec4f,
    farthest_w: f32,
}

@group(GROUP) @binding(0) var<uniform> parameters: UpsampleScatteringParameters;
@group(GROUP) @binding(2) var scattering: texture_2d<f32>;

// One over the distance of a pixel's surface along the camera's axis, up to a factor.
fn per_distance(pixel: vec2i) -> f32 {
    let clip = camera_depth_clip(camera_depth_pixel(pixel), camera_depth_at(pixel));
    return max(max(dot(parameters.scene_w_from_camera, clip), parameters.farthest_w), 1e-30);
}

@fragment
fn upsample(covered: Covered) -> @location(0) vec4f {
    let pixel = camera_depth_pixel_around(covered.uv).pixel;
    let last = vec2i(textureDimensions(scattering)) - 1;
    let per_texel = i32(PER_TEXEL);
    // Texels have what the pixels in their middles see.
    let place = (vec2f(pixel) - f32(PER_TEXEL / 2u)) / f32(PER_TEXEL);
    let low = vec2i(floor(place));
    let part = place - floor(place);
    let own = per_distance(pixel);
    let first = textureLoad(scattering, clamp(low, vec2i(0), last), 0);
    var sum = vec4f(0.0);
    var weights = 0.0;
    for (var index = 0u; index < 4u; index++) {
        let step = vec2i(vec2u(index & 1u, index >> 1u));
        let texel = clamp(low + step, vec2i(0), last);
        let shares = select(1.0 - part, part, step == vec2i(1));
        let seen = min(texel * per_texel + per_texel / 2, camera_depth_size() - 1);
        let weight = upsample_weight(shares.x * shares.y, own, per_distance(seen));
        // Differences, so that four equal texels give that to the bit.
        sum += weight * (textureLoad(scattering, texel, 0) - first);
        weights += weight;
    }
    return first + sum / max(weights, 1e-9);
}
