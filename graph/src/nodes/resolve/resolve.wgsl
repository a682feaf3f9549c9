import node::region_tile::{region_tile};
import node::resolve_texel::{resolve_texel};
import node::specialization::{GROUP, MomentsStorage};

// Resolves the regions of one layer of a depth map to one plane of a filterable map: one texel per invocation.

@group(GROUP) @binding(2) var moments_map: MomentsStorage;

@compute @workgroup_size(8, 8)
fn resolve(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup, workgroups, textureDimensions(moments_map), 0u, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let texel = vec2i(tile.region.origin + place);
    textureStore(moments_map, texel, resolve_texel(texel, tile.number));
}
