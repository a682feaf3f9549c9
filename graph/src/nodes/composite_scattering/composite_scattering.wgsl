import node::camera_depth::{camera_depth_pixel_around};
import node::fullscreen::{Covered};
import node::moments_lookup::{moments_map};
import node::scattering_bounds::{scattering_bounds};
import node::scattering_ray::{scattering_ray_of};
import node::specialization::{GROUP, OVERESTIMATION};
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_prefix, rectified_frame_row};
import moment_shadows::air::single_scattering::{SingleScattering, single_scattering_pixel, single_scattering_ray, single_scattering_shadow};

// In-scattered radiance of every pixel from the camera's depth and the integrated map, to be added to the picture behind the
// medium, which is first multiplied by the transmittance.

struct CompositeScatteringParameters {
    frame: RectifiedFrame,
    medium: SingleScattering,
}

@group(GROUP) @binding(0) var<uniform> parameters: CompositeScatteringParameters;

@fragment
fn composite(covered: Covered) -> @location(0) vec4f {
    let ray = scattering_ray_of(parameters.frame, camera_depth_pixel_around(covered.uv));
    let size = vec2f(textureDimensions(moments_map).xy);
    let map_uv = vec2f(rectified_frame_prefix(ray.place.x, size.x), rectified_frame_row(ray.place.y, size.y));
    let bounds = scattering_bounds(map_uv, ray.depth);
    let shadow = single_scattering_shadow(bounds, ray.cosine, OVERESTIMATION);
    return single_scattering_pixel(single_scattering_ray(parameters.medium, ray.length, ray.cosine, shadow));
}
