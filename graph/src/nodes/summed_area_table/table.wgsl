import node::regions::{region_tile};
import node::specialization::{GROUP, TILE, WORKGROUP_X, WORKGROUP_Y};
import node::sums::{target_map};
import node::tile_columns::{TileColumns, add_row, load_columns, store_columns};

// Last pass: the table, one tile per invocation. It begins with the row of the table above the tile; each row adds its own
// texels, and for what lies to the left the row prefix.

@group(GROUP) @binding(2) var row_prefixes: texture_2d<u32>;
@group(GROUP) @binding(3) var column_prefixes: texture_2d<u32>;

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn make_table(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup_id, workgroups, textureDimensions(target_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * TILE);
    let place = tile.first + local.xy * TILE;
    if any(place >= tile.region.extent) {
        return;
    }
    let first = tile.region.origin + place;
    // The places of the tiles to the left and above.
    let before = max((first + TILE - 1u) / TILE, vec2u(1u)) - 1u;
    var columns: TileColumns;
    if place.y > 0u {
        columns = load_columns(column_prefixes, vec2u(first.x, before.y));
    }
    let size = min(TILE, tile.region.extent - place);
    for (var row = 0u; row < size.y; row++) {
        let y = first.y + row;
        columns = add_row(vec2u(first.x, y), columns);
        var left: vec4u;
        if place.x > 0u {
            left = textureLoad(row_prefixes, vec2u(before.x, y), 0);
        }
        store_columns(vec2u(first.x, y), size.x, columns, left);
    }
}
