import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel, camera_depth_size};
import node::fullscreen::{Covered};
import moment_shadows::map::map_region::{MapRegion};
import node::moments_lookup::{moments_map};
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_coordinates, rectified_frame_depth, rectified_frame_place, rectified_frame_prefix, rectified_frame_row, rectified_frame_surface};
import node::scattering_bounds::{scattering_bounds};
import moment_shadows::air::single_scattering::{SingleScattering, single_scattering_fragment_depth, single_scattering_pixel, single_scattering_radiance, single_scattering_shadow, single_scattering_transmittance};
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
    let picture = camera_depth_size();
    let pixel = clamp(vec2i(covered.uv * vec2f(picture)), vec2i(0), picture - 1);
    let clip = camera_depth_clip(camera_depth_pixel(pixel), camera_depth_at(pixel));
    let surface = rectified_frame_surface(parameters.frame, clip.xy, clip.z);
    let coordinates = rectified_frame_coordinates(surface);
    let distance = length(surface);
    let cosine = clamp(surface.z / max(distance, 1e-30), -1.0, 1.0);

    let size = textureDimensions(moments_map);
    let texels = vec2f(size);
    let place = rectified_frame_place(parameters.frame, coordinates);
    let map_uv = vec2f(rectified_frame_prefix(place.x, texels.x), rectified_frame_row(place.y, texels.y));
    let depth = single_scattering_fragment_depth(rectified_frame_depth(parameters.frame, coordinates.z));
    let bounds = scattering_bounds(map_uv, MapRegion(vec2u(0u), size), depth);
    let shadow = single_scattering_shadow(bounds, cosine, OVERESTIMATION);

    let radiance = single_scattering_radiance(parameters.medium, distance, cosine, shadow);
    let transmittance = single_scattering_transmittance(parameters.medium, distance);
    return single_scattering_pixel(radiance, transmittance);
}
