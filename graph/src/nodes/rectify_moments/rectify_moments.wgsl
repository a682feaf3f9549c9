import moment_shadows::maths::angle::{angle_atan2, angle_sin_cos};
import moment_shadows::map::map_region::{map_region_within};
import moment_shadows::moments::four_moments::{four_moments_from_texel};
import node::moments_lookup::{moments_lookup, moments_map};
import moment_shadows::air::rectified_frame::{rectified_frame_depth, rectified_frame_ray};
import node::occluders::{occluders_of};
import node::occluders_shares::{Occluders};
import node::rectified_texel::{rectified_map, rectified_store};
import node::rectify_parameters::{parameters};
import node::specialization::{SOURCE_STORAGE};
import moment_shadows::map::storage::{storage_finite_texel};
import moment_shadows::maths::two_diracs::{two_diracs_of_moments};

// Resamples a filtered map of four moments in rectified coordinates: one texel, which is one light ray, per invocation.
//
// Depth along the light is not linear in the depth of the light's map, so moments cannot be converted; the two depths that stand
// for a texel can (Peters et al., JCGT 6(1) 2017, section 7). Every texel is looked up in the light's map, so there are no
// holes, whatever the directions of camera and light.

// From here on depths of the light's map are its far end, where there are no casters: those of filtered texels spread by
// what a storage's rounding leaves of them.
const FAR_END = 0.97;

// The rectified depth of an occluder at a depth of the light's map, on the light ray of a radius.
fn rectified(depth: f32, radius: f32) -> f32 {
    let along = (max(depth, -1.0) - parameters.depth_at_camera) / parameters.depth_per_length;
    let rectified = rectified_frame_depth(parameters.frame, angle_atan2(radius, along));
    return select(rectified, 1.0, depth >= FAR_END);
}

@compute @workgroup_size(8, 8)
fn rectify(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(rectified_map);
    if any(id.xy >= size) {
        return;
    }
    // Columns are intervals of the radius, rows azimuths from end to end.
    let place = vec2f((f32(id.x) + 0.5) / f32(size.x), f32(id.y) / f32(max(size.y, 2u) - 1u));
    let ray = rectified_frame_ray(parameters.frame, place);
    let turn = angle_sin_cos(ray.y);
    let outwards = turn.y * parameters.map_along_first + turn.x * parameters.map_along_second;
    let around = turn.y * parameters.map_along_second - turn.x * parameters.map_along_first;
    let uv = parameters.map_at_camera + ray.x * outwards;
    if any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) {
        // What the light's map does not know casts no shadow.
        rectified_store(id.xy, Occluders(vec2f(1.0), array<vec2f, 2>()), vec2f(0.5));
        return;
    }
    let region = map_region_within(parameters.region, textureDimensions(moments_map));
    let texels = vec2f(region.extent);
    let column = parameters.frame.largest_radius / f32(size.x) * texels * outwards;
    let row = ray.x * parameters.frame.azimuth_extent / f32(size.y) * texels * around;
    let texel = moments_lookup(parameters.layer, region, uv, column, row);
    let moments = four_moments_from_texel(storage_finite_texel(texel, SOURCE_STORAGE), SOURCE_STORAGE);
    let occluders = two_diracs_of_moments(moments.xyz);
    // View rays that end within the first column run along the light: whatever is before the camera shadows all of them.
    let radius = select(ray.x, 0.0, id.x == 0u);
    let depths = vec2f(rectified(occluders.depths.x, radius), rectified(occluders.depths.y, radius));
    rectified_store(id.xy, occluders_of(id.xy, depths), occluders.weights);
}
