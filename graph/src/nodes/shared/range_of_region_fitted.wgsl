import moment_shadows::map::range_fit::{RangeFit, range_fit_of_texel};
import node::specialization::{GROUP};

// The fitted ranges of the one layer of a map that a pass is recorded for.

@group(GROUP) @binding(7) var ranges_map: texture_2d<f32>;

fn range_of_region(number: u32) -> RangeFit {
    return range_fit_of_texel(textureLoad(ranges_map, vec2u(number, 0u), 0));
}
