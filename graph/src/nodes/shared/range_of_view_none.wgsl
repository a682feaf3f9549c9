import moment_shadows::map::range_fit::{RangeFit, range_fit_none};

// A map in the host's range.

fn range_of_view(layer: u32, origin: vec2u) -> RangeFit {
    return range_fit_none();
}
