import node::integrate_target::{row_thickness};
import node::planes::{Planes, planes_fma, planes_load, planes_store, rectified_map};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column};

// Normalised prefix sums along rows, on a software adapter: a row per invocation, without shared memory. Means are f32 and are
// rounded once, to the storage.

const LINES = 64u;

// The means of the texels up to a column, and the sum of their weights.
struct IntegrateSum {
    mean: Planes,
    weight: f32,
}

// Goes on by a column. Beyond the end of the row nothing is stored.
fn integrate_column(before: IntegrateSum, column: u32, row: u32, thickness: f32) -> IntegrateSum {
    let of_column = scattering_weights_of_column(thickness, f32(column));
    let weight = before.weight + of_column;
    let mean = planes_fma(of_column / weight, planes_load(column, row) - before.mean, before.mean);
    planes_store(column, row, mean);
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
    var sum = IntegrateSum(Planes(), 0.0);
    // Four by four: what a loop costs is much of what a column does.
    for (var column = 0u; column < size.x; column += 4u) {
        sum = integrate_column(sum, column, row, thickness);
        sum = integrate_column(sum, column + 1u, row, thickness);
        sum = integrate_column(sum, column + 2u, row, thickness);
        sum = integrate_column(sum, column + 3u, row, thickness);
    }
}
