import moment_shadows::techniques::convolution::{CONVOLUTION_DAMPING, convolution_plane, convolution_receiver, convolution_shadow_intensity};
import moment_shadows::air::rectified_frame::{rectified_frame_coordinates, rectified_frame_depth, rectified_frame_place, rectified_frame_prefix, rectified_frame_row};
import node::scattering_view::{view, view_cosine, view_dimming, view_surface};
import moment_shadows::air::single_scattering::{single_scattering_ray};
import moment_shadows::map::storage::{STORAGE_FLOAT16};

// In-scattered radiance from the rows of a convolution shadow map: four fetches per pixel.

@group(0) @binding(2) var rows: texture_2d_array<f32>;
@group(0) @binding(3) var rows_sampler: sampler;

const PLANES = 4u;

@fragment
fn composite(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let surface = view_surface(vec2i(position.xy));
    let coordinates = rectified_frame_coordinates(surface);
    let size = vec2f(textureDimensions(rows));
    let place = rectified_frame_place(view.frame, coordinates);
    let uv = vec2f(rectified_frame_prefix(place.x, size.x), rectified_frame_row(place.y, size.y));
    let terms = 2u * PLANES;
    let receiver = convolution_receiver(rectified_frame_depth(view.frame, coordinates.z), terms, false);
    var sum = 0.0;
    for (var plane = 0u; plane < PLANES; plane++) {
        let texel = textureSampleLevel(rows, rows_sampler, uv, plane, 0.0);
        sum += convolution_plane(texel, STORAGE_FLOAT16, plane, terms, receiver, CONVOLUTION_DAMPING);
    }
    let shadow = convolution_shadow_intensity(sum, terms, false);
    let distance = length(surface);
    let ray = single_scattering_ray(view.medium, distance, view_cosine(surface), shadow);
    return vec4f(ray.radiance, view_dimming(ray.transmittance));
}
