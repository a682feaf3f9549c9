import moment_shadows::maths::angle::{angle_atan2, angle_sin_cos};
import moment_shadows::techniques::convolution::{convolution_channels, convolution_to_texel};
import moment_shadows::air::rectified_frame::{rectified_frame_depth, rectified_frame_ray};
import node::scattering_view::{view};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column, scattering_weights_thickness};
import moment_shadows::map::storage::{STORAGE_FLOAT16};

// Klehm et al., "Prefiltered single scattering", i3D 2014: the plain depth map in rectified coordinates, as convolution shadow
// map, summed up along rows. A row per invocation; four planes of four channels.

@group(0) @binding(2) var light_depth: texture_depth_2d;
@group(0) @binding(3) var rows: texture_storage_2d_array<rgba16float, write>;

const PLANES = 4u;

// The rectified depth of the caster at a place of the map, on a light ray.
fn occluder(uv: vec2f, radius: f32) -> f32 {
    let size = vec2f(textureDimensions(light_depth));
    let stored = textureLoad(light_depth, vec2i(min(saturate(uv) * size, size - 1.0)), 0);
    let along = (fma(2.0, stored, -1.0) - view.depth_at_camera) / view.depth_per_length;
    let depth = rectified_frame_depth(view.frame, angle_atan2(radius, along));
    let known = all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0)) && stored < 1.0;
    return select(1.0, depth, known);
}

@compute @workgroup_size(64)
fn sum_rows(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(rows);
    if id.x >= size.y {
        return;
    }
    let azimuth = rectified_frame_ray(view.frame, vec2f(0.0, f32(id.x) / f32(max(size.y, 2u) - 1u))).y;
    let turn = angle_sin_cos(azimuth);
    let outwards = turn.y * view.map_along_first + turn.x * view.map_along_second;
    let thickness = scattering_weights_thickness(view.frame, azimuth, view.medium.mean_extinction, f32(size.x));
    var means: array<vec4f, PLANES>;
    var weights = 0.0;
    for (var column = 0u; column < size.x; column++) {
        let radius = (f32(column) + 0.5) / f32(size.x) * view.frame.largest_radius;
        let depth = occluder(view.map_at_camera + radius * outwards, select(radius, 0.0, column == 0u));
        let weight = scattering_weights_of_column(thickness, f32(column));
        weights += weight;
        for (var plane = 0u; plane < PLANES; plane++) {
            let channels = convolution_channels(depth, plane, 2u * PLANES);
            means[plane] = fma(vec4f(weight / weights), channels - means[plane], means[plane]);
            textureStore(rows, vec2u(column, id.x), plane, convolution_to_texel(means[plane], STORAGE_FLOAT16));
        }
    }
}
