import moment_shadows::integrate_target::{integrated_map, rectified_map, row_thickness};
import moment_shadows::map_filtering::{filtering_texel};
import moment_shadows::scattering_weights::{scattering_weights_of_column};

// Normalised prefix sums along rows, on a software adapter: a row per invocation, without shared memory. Means are f32 and are
// rounded once, to the storage.

const LINES = 64u;

@compute @workgroup_size(LINES)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u) {
    let size = textureDimensions(rectified_map);
    let row = workgroup.y * LINES + local.x;
    if row >= size.y {
        return;
    }
    let thickness = row_thickness(row);
    var mean = vec4f(0.0);
    var weight = 0.0;
    for (var column = 0u; column < size.x; column++) {
        let of_column = scattering_weights_of_column(thickness, f32(column));
        weight += of_column;
        let texel = textureLoad(rectified_map, vec2u(column, row), 0);
        mean = fma(vec4f(of_column / weight), texel - mean, mean);
        textureStore(integrated_map, vec2u(column, row), filtering_texel(mean));
    }
}
