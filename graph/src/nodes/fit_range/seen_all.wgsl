import moment_shadows::map::depth::{DepthConversion};
import node::specialization::{GROUP, REGIONS};

// The camera may see anything.

@group(GROUP) @binding(0) var<uniform> conversions: array<DepthConversion, REGIONS>;

// Less than any end.
const NOTHING_SEEN = -2.0;

fn seen_conversion(number: u32) -> DepthConversion {
    return conversions[number];
}

fn seen_end(number: u32, first: u32, step: u32) -> f32 {
    return 1.0;
}
