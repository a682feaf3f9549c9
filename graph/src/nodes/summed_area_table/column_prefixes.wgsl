import node::regions::{region_tile};
import node::specialization::{GROUP, TILE};
import node::sums::{sums_texel, target_map};

// Third pass: the rows of the table at the lower edges of tiles, one column of a region per invocation. To a tile's own sums
// up to the column those of the tiles to its left are added: the last of their row prefixes.

@group(GROUP) @binding(0) var column_sums: texture_2d<u32>;
@group(GROUP) @binding(2) var row_prefixes: texture_2d<u32>;

const LINES = 64u;

// The sums of a row of tiles, up to the column x.
fn tile_row_sum(x: u32, slot: u32, left: u32, last_row: u32, is_first: bool) -> vec4u {
    let before = select(textureLoad(row_prefixes, vec2u(left, last_row), 0), vec4u(0u), is_first);
    return textureLoad(column_sums, vec2u(x, slot), 0) + before;
}

@compute @workgroup_size(LINES)
fn sum_columns(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    // As far as tiles reach, which may be beyond the map.
    let size = textureDimensions(column_sums) * vec2u(1u, TILE.y);
    let lines = region_tile(workgroup_id, workgroups, size, 0u, vec2u(LINES, 65536u));
    let line = lines.first.x + local.x;
    if line >= lines.region.extent.x || lines.region.extent.y == 0u {
        return;
    }
    let x = lines.region.origin.x + line;
    let is_first = line < TILE.x;
    // The place of the tile to the left.
    let tile = (lines.region.origin.x + TILE.x - 1u) / TILE.x + line / TILE.x;
    let left = max(tile, 1u) - 1u;
    let first = (lines.region.origin.y + TILE.y - 1u) / TILE.y;
    let end = first + (lines.region.extent.y - 1u) / TILE.y;
    var last_row = lines.region.origin.y + TILE.y - 1u;
    var sum: vec4u;
    // Two tiles at a time, with two loads each, hide each other's latency.
    for (var y = first; y < end; y += 2u) {
        let s0 = tile_row_sum(x, y, left, last_row, is_first);
        let s1 = tile_row_sum(x, y + 1u, left, last_row + TILE.y, is_first);
        sum += s0;
        textureStore(target_map, vec2u(x, y), sums_texel(sum));
        sum += s1;
        if y + 1u < end {
            textureStore(target_map, vec2u(x, y + 1u), sums_texel(sum));
        }
        last_row += 2u * TILE.y;
    }
}
