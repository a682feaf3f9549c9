import moment_shadows::map::range_fit::{RangeFit, range_fit_load};
import node::specialization::{GROUP};

// The fitted ranges of all layers of a map.

@group(GROUP) @binding(7) var ranges_map: texture_2d_array<f32>;

// The range of the region of a layer that begins at `origin`.
fn range_of_view(layer: u32, origin: vec2u) -> RangeFit {
    return range_fit_load(ranges_map, layer, origin);
}
