import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel_around};
import node::fullscreen::{Covered};
import node::moments_lookup::{moments_map};
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_depth, rectified_frame_direction, rectified_frame_place, rectified_frame_prefix, rectified_frame_row, rectified_frame_view_ray, rectified_frame_w};
import node::scattering_bounds::{scattering_bounds};
import moment_shadows::air::single_scattering::{SingleScattering, single_scattering_fragment_depth, single_scattering_pixel, single_scattering_ray, single_scattering_shadow};
import node::specialization::{GROUP, OVERESTIMATION};

// In-scattered radiance of every pixel from the camera's depth and the integrated map, to be added to the picture behind the
// medium, which is first multiplied by the transmittance.

struct CompositeScatteringParameters {
    frame: RectifiedFrame,
    medium: SingleScattering,
}

@group(GROUP) @binding(0) var<uniform> parameters: CompositeScatteringParameters;

@fragment
fn composite(covered: Covered) -> @location(0) vec4f {
    let pixel = camera_depth_pixel_around(covered.uv);
    let clip = camera_depth_clip(pixel, camera_depth_at(pixel.pixel));
    let direction = rectified_frame_direction(parameters.frame, clip.xy);
    let per_w = 1.0 / rectified_frame_w(parameters.frame, clip.xy, clip.z);
    let ray = rectified_frame_view_ray(direction);
    let distance = ray.length * per_w;
    let cosine = direction.z / max(ray.length, 1e-30);

    let size = vec2f(textureDimensions(moments_map).xy);
    let place = rectified_frame_place(parameters.frame, ray.coordinates * vec3f(per_w, 1.0, 1.0));
    let map_uv = vec2f(rectified_frame_prefix(place.x, size.x), rectified_frame_row(place.y, size.y));
    let depth = single_scattering_fragment_depth(rectified_frame_depth(parameters.frame, ray.coordinates.z));
    let bounds = scattering_bounds(map_uv, depth);
    let shadow = single_scattering_shadow(bounds, cosine, OVERESTIMATION);

    return single_scattering_pixel(single_scattering_ray(parameters.medium, distance, cosine, shadow));
}
