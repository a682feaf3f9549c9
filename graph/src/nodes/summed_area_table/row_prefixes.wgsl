import moment_shadows::filter::prefix_sum::{prefix_sum_along};
import node::regions::{region_tile};
import node::specialization::{GROUP, TILE};
import node::sums::{sums_load_four, sums_store_four};

// Second pass: prefix sums of the tiles' row sums, one row of a region per invocation. A prefix lies where the last tile lies
// that it contains.

@group(GROUP) @binding(0) var row_sums: texture_2d<u32>;

const LINES = 64u;

@compute @workgroup_size(LINES)
fn sum_rows(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    // As far as tiles reach, which may be beyond the map.
    let size = textureDimensions(row_sums) * vec2u(TILE.x, 1u);
    let lines = region_tile(workgroup_id, workgroups, size, 0u, vec2u(65536u, LINES));
    let line = lines.first.y + local.x;
    if line >= lines.region.extent.y || lines.region.extent.x == 0u {
        return;
    }
    let y = lines.region.origin.y + line;
    let first = (lines.region.origin.x + TILE.x - 1u) / TILE.x;
    // No tile follows the last one and would need its sum.
    let end = first + (lines.region.extent.x - 1u) / TILE.x;
    var before = vec4u(0u);
    // Four loads at a time hide each other's latency.
    for (var x = first; x < end; x += 4u) {
        let sums = prefix_sum_along(before, sums_load_four(row_sums, vec2u(x, y)));
        sums_store_four(vec2u(x, y), end - x, sums);
        before = sums.s3;
    }
}
