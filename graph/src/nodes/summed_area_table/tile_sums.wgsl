import node::regions::{region_tile};
import node::specialization::{GROUP, SumsStorage, TILE, WORKGROUP_X, WORKGROUP_Y};
import node::sums::{sums_texel};
import node::tile_columns::{TileColumns, last_column, add_row, moments_map, store_columns};

// First pass: the sums of tiles, one tile per invocation.
//
// A tile hands on the sums of all its columns up to each of its rows, and of all its rows up to each of its columns. Tiles
// begin at the origin of their region. Only those with another one beyond have anything to hand on, and these are whole:
// they hold exactly one multiple of the tile's size along each axis, whose number is their place in the textures of sums.
// So no two tiles of a layer share a place, wherever its regions lie.

@group(GROUP) @binding(2) var row_sums: SumsStorage;

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn sum_tiles(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup_id, workgroups, textureDimensions(moments_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * TILE);
    let place = tile.first + local.xy * TILE;
    let is_last = place + TILE >= tile.region.extent;
    if any(place >= tile.region.extent) || all(is_last) {
        return;
    }
    let first = tile.region.origin + place;
    let slot = (first + TILE - 1u) / TILE;
    let rows = min(TILE.y, tile.region.extent.y - place.y);
    var columns: TileColumns;
    for (var row = 0u; row < rows; row++) {
        columns = add_row(first + vec2u(0u, row), columns);
        if !is_last.x {
            textureStore(row_sums, vec2u(slot.x, first.y + row), sums_texel(last_column(columns)));
        }
    }
    if !is_last.y {
        store_columns(vec2u(first.x, slot.y), min(TILE.x, tile.region.extent.x - place.x), columns, vec4u(0u));
    }
}
