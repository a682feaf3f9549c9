import node::integrate_target::{integrated_map, rectified_map, row_thickness};
import node::map_filtering::{filtering_texel};
import node::row_sums::{RowSums, row_sums_join, row_sums_mean, row_sums_texel};

// Normalised prefix sums along rows, on a software adapter: a row per invocation, without shared memory. Sums are f32 and are
// rounded once, to the storage.

const LINES = 64u;

// Goes on by a column. Beyond the end of the row nothing is stored.
fn integrate_column(before: RowSums, column: u32, row: u32, thickness: f32) -> RowSums {
    let place = vec2u(column, row);
    let sums = row_sums_join(before, row_sums_texel(textureLoad(rectified_map, place, 0), f32(column), thickness));
    textureStore(integrated_map, place, filtering_texel(row_sums_mean(sums, place, thickness)));
    return sums;
}

@compute @workgroup_size(LINES)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let size = textureDimensions(rectified_map);
    let row = workgroup_id.y * LINES + local.x;
    if row >= size.y {
        return;
    }
    let thickness = row_thickness(row);
    var sums = RowSums();
    // Four by four: what a loop costs is much of what a column does.
    for (var column = 0u; column < size.x; column += 4u) {
        sums = integrate_column(sums, column, row, thickness);
        sums = integrate_column(sums, column + 1u, row, thickness);
        sums = integrate_column(sums, column + 2u, row, thickness);
        sums = integrate_column(sums, column + 3u, row, thickness);
    }
}
