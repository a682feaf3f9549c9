import moment_shadows::map::map_region::{MapRegion};
import node::map_filtering::{filtering_texel};
import node::regions::{region_at};
import node::specialization::{GROUP};

// What a texel of a mip level holds, from one layer of the finer level.
//
// A texel is the exact mean over the part of the finer level that it covers, whatever the region's size: two texels along
// an axis where that is even, up to three where it is odd. Unlike a mean of the two nearest texels, it counts the last row
// of a region with an odd size as much as the others.

// The mip level that is made, at least 1.
override LEVEL: u32;

@group(GROUP) @binding(0) var finer_level: texture_2d<f32>;

// The weights of three texels in a row of a box that is `width` texels wide and begins at `start` in the first of them.
fn box_weights(start: f32, width: f32) -> vec3f {
    let texel = vec3f(0.0, 1.0, 2.0);
    let covered = max(min(texel + 1.0, vec3f(start + width)) - max(texel, vec3f(start)), vec3f(0.0));
    // The box covers at least one texel in all.
    return covered / (covered.x + covered.y + covered.z);
}

fn written_size() -> vec2u {
    return textureDimensions(finer_level) << vec2u(LEVEL - 1u);
}

fn written_texel(texel: vec2u, region: MapRegion, number: u32) -> vec4f {
    let finer = region_at(number, written_size(), LEVEL - 1u);
    let extent = region.extent;
    // In whole numbers as far as possible: a texel at the far end of a large map loses no digits.
    let start = (texel - region.origin) * finer.extent;
    let width = vec2f(finer.extent) / vec2f(extent);
    let offset = vec2f(start % extent) / vec2f(extent);
    let across = box_weights(offset.x, width.x);
    let down = box_weights(offset.y, width.y);
    let first = vec2i(finer.origin + start / extent);
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
    return filtering_texel(sum);
}
