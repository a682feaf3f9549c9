import node::integrate_target::{integrated_map, rectified_map, row_thickness};
import node::map_filtering::{filtering_texel};
import node::row_sums::{RowSums, row_sums_join, row_sums_mean, row_sums_texel};

// Normalised prefix sums along rows, on a GPU: a workgroup per row, 8 texels per invocation, the sums of invocations by the
// scan of Hillis and Steele (1986). Texels are loaded twice, since sums of all of them at once would not fit registers. Sums are
// f32 and are rounded once, to the storage.

const THREADS = 64u;
const TEXELS = 8u;

var<workgroup> sums: array<RowSums, THREADS>;

fn sums_of_texel(column: u32, row: u32, thickness: f32) -> RowSums {
    let last = textureDimensions(rectified_map).x - 1u;
    let texel = textureLoad(rectified_map, vec2u(min(column, last), row), 0);
    return row_sums_texel(texel, f32(column), thickness);
}

@compute @workgroup_size(THREADS)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let columns = textureDimensions(rectified_map).x;
    let row = workgroup_id.y;
    let thickness = row_thickness(row);
    let thread = local.x;
    var before = RowSums();
    for (var start = 0u; start < columns; start += THREADS * TEXELS) {
        let first = start + thread * TEXELS;
        var sum = RowSums();
        for (var index = 0u; index < TEXELS; index++) {
            sum = row_sums_join(sum, sums_of_texel(first + index, row, thickness));
        }
        sums[thread] = sum;
        workgroupBarrier();
        for (var step = 1u; step < THREADS; step *= 2u) {
            var added = RowSums();
            if thread >= step {
                added = sums[thread - step];
            }
            workgroupBarrier();
            sums[thread] = row_sums_join(sums[thread], added);
            workgroupBarrier();
        }
        var inner = before;
        if thread > 0u {
            inner = row_sums_join(before, sums[thread - 1u]);
        }
        for (var index = 0u; index < TEXELS; index++) {
            let place = vec2u(first + index, row);
            inner = row_sums_join(inner, sums_of_texel(place.x, row, thickness));
            if place.x < columns {
                textureStore(integrated_map, place, filtering_texel(row_sums_mean(inner, place, thickness)));
            }
        }
        before = row_sums_join(before, sums[THREADS - 1u]);
        workgroupBarrier();
    }
}
