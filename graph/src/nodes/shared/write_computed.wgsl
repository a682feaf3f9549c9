import node::map_texture::{texel_to_texture};
import node::regions::{region_tile};
import node::specialization::{GROUP, MomentsStorage};
import node::written_texel::{LEVEL, written_size, written_texel};

// Writes a mip level of the regions of one layer of a map: one texel per invocation.

@group(GROUP) @binding(3) var written_map: MomentsStorage;

@compute @workgroup_size(8, 8)
fn write_map(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup_id, workgroups, written_size(), LEVEL, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let texel = tile.region.origin + place;
    textureStore(written_map, texel, texel_to_texture(written_texel(texel, tile.region, tile.number)));
}
