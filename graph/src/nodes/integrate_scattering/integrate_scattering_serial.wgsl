import node::integrate_target::{integrated_map, rectified_map, row_thickness};
import node::map_filtering::{filtering_texel};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column};

// Normalised prefix sums along rows, on a software adapter: a row per invocation, without shared memory. Means are f32 and are
// rounded once, to the storage.

const LINES = 64u;

// The mean of the texels up to a column, and the sum of their weights.
struct IntegrateSum {
    mean: vec4f,
    weight: f32,
}

// Goes on by a column. Beyond the end of the row nothing is stored.
fn integrate_column(before: IntegrateSum, column: u32, row: u32, thickness: f32) -> IntegrateSum {
    let of_column = scattering_weights_of_column(thickness, f32(column));
    let weight = before.weight + of_column;
    let texel = textureLoad(rectified_map, vec2u(column, row), 0);
    let mean = fma(vec4f(of_column / weight), texel - before.mean, before.mean);
    textureStore(integrated_map, vec2u(column, row), filtering_texel(mean));
    return IntegrateSum(mean, weight);
}

@compute @workgroup_size(LINES)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let size = textureDimensions(rectified_map);
    let row = workgroup_id.y * LINES + local.x;
    if row >= size.y {
        return;
    }
    let thickness = row_thickness(row);
    var sum = IntegrateSum(vec4f(0.0), 0.0);
    // Four by four: what a loop costs is much of what a column does.
    for (var column = 0u; column < size.x; column += 4u) {
        sum = integrate_column(sum, column, row, thickness);
        sum = integrate_column(sum, column + 1u, row, thickness);
        sum = integrate_column(sum, column + 2u, row, thickness);
        sum = integrate_column(sum, column + 3u, row, thickness);
    }
}
