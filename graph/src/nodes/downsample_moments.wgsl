import moment_shadows::map_filtering::{filtering_texel};
import moment_shadows::map_region::{map_region_at_level, map_region_within};
import moment_shadows::region_tile::{region_tile, regions};
import moment_shadows::specialization::{GROUP, MomentsStorage};

// Makes one mip level of the regions of one layer out of the finer one: one texel per invocation.
//
// A texel is the exact mean over the part of the finer level that it covers, whatever the region's size: two texels along
// an axis where that is even, up to three where it is odd. Other than with the two texels that are next to it, the last
// row of a region with an odd size counts as much as the others.

// The mip level that is made, at least 1.
override LEVEL: u32;

@group(GROUP) @binding(0) var finer_level: texture_2d<f32>;
@group(GROUP) @binding(1) var coarser_level: MomentsStorage;

// The weights of three texels in a row of a box that is `width` texels wide and begins at `start` in the first of them.
fn box_weights(start: f32, width: f32) -> vec3f {
    let texel = vec3f(0.0, 1.0, 2.0);
    let covered = max(min(texel + 1.0, vec3f(start + width)) - max(texel, vec3f(start)), vec3f(0.0));
    // The box covers at least one texel in all.
    return covered / (covered.x + covered.y + covered.z);
}

@compute @workgroup_size(8, 8)
fn downsample(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let size = textureDimensions(finer_level) << vec2u(LEVEL - 1u);
    let tile = region_tile(workgroup, workgroups, size, LEVEL, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let finer = map_region_at_level(map_region_within(regions[tile.number], size), LEVEL - 1u);
    // In whole numbers as far as possible: a texel at the far end of a large map loses no digits.
    let start = place * finer.extent;
    let width = vec2f(finer.extent) / vec2f(tile.region.extent);
    let offset = vec2f(start % tile.region.extent) / vec2f(tile.region.extent);
    let across = box_weights(offset.x, width.x);
    let down = box_weights(offset.y, width.y);
    let first = vec2i(finer.origin + start / tile.region.extent);
    let last = vec2i(finer.origin + finer.extent) - 1;
    var sum = vec4f(0.0);
    for (var y = 0; y < 3; y++) {
        for (var x = 0; x < 3; x++) {
            let weight = across[x] * down[y];
            if weight > 0.0 {
                sum = fma(vec4f(weight), textureLoad(finer_level, min(first + vec2i(x, y), last), 0), sum);
            }
        }
    }
    let texel = tile.region.origin + place;
    textureStore(coarser_level, texel, filtering_texel(sum));
}
