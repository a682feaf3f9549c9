import node::region_tile::{region_tile};
import node::specialization::{GROUP, SumsStorage, TILE};
import node::sums::{Sums, sums_of, sums_texel};

// Second pass: prefix sums of the tiles' row sums, one row of a region per invocation. A prefix lies where the last tile lies
// that it contains.

@group(GROUP) @binding(0) var row_sums: texture_2d<u32>;
@group(GROUP) @binding(1) var row_prefixes: SumsStorage;

const LINES = 64u;

@compute @workgroup_size(LINES)
fn sum_rows(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    // As far as tiles reach, which may be beyond the map.
    let size = textureDimensions(row_sums) * vec2u(TILE.x, 1u);
    let lines = region_tile(workgroup, workgroups, size, 0u, vec2u(65536u, LINES));
    let line = lines.first.y + local.x;
    if line >= lines.region.extent.y || lines.region.extent.x == 0u {
        return;
    }
    let y = lines.region.origin.y + line;
    let first = (lines.region.origin.x + TILE.x - 1u) / TILE.x;
    // Beyond the last tile is none that would need its sum.
    let end = first + (lines.region.extent.x - 1u) / TILE.x;
    var sum: Sums;
    // Four loads at a time hide each other's latency.
    for (var x = first; x < end; x += 4u) {
        let t0 = sums_of(textureLoad(row_sums, vec2u(x, y), 0));
        let t1 = sums_of(textureLoad(row_sums, vec2u(x + 1u, y), 0));
        let t2 = sums_of(textureLoad(row_sums, vec2u(x + 2u, y), 0));
        let t3 = sums_of(textureLoad(row_sums, vec2u(x + 3u, y), 0));
        sum += t0;
        textureStore(row_prefixes, vec2u(x, y), sums_texel(sum));
        sum += t1;
        if x + 1u < end {
            textureStore(row_prefixes, vec2u(x + 1u, y), sums_texel(sum));
        }
        sum += t2;
        if x + 2u < end {
            textureStore(row_prefixes, vec2u(x + 2u, y), sums_texel(sum));
        }
        sum += t3;
        if x + 3u < end {
            textureStore(row_prefixes, vec2u(x + 3u, y), sums_texel(sum));
        }
    }
}
