import node::downsample_texel::{downsample_texel, finer_level};
import moment_shadows::map::map_region::{map_region_at_level, map_region_within};
import node::region_tile::{region_tile, regions};
import node::specialization::{GROUP, MomentsStorage};

// Makes one mip level of the regions of one layer out of the finer one: one texel per invocation.

// The mip level that is made, at least 1.
override LEVEL: u32;

@group(GROUP) @binding(1) var coarser_level: MomentsStorage;

@compute @workgroup_size(8, 8)
fn downsample(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let size = textureDimensions(finer_level) << vec2u(LEVEL - 1u);
    let tile = region_tile(workgroup, workgroups, size, LEVEL, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let finer = map_region_at_level(map_region_within(regions[tile.number], size), LEVEL - 1u);
    textureStore(coarser_level, tile.region.origin + place, downsample_texel(place, tile.region.extent, finer));
}
