import node::debug_colours::{debug_ramp};
import node::filter_width::{filter_width};
import node::technique_receiver::{TechniqueReceiver};

// Half the width of the pixel's own filter in texels: blue at a half, green at four, red at 32.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    return debug_ramp((log2(clamp(filter_width(view, receiver), 0.5, 32.0)) + 1.0) / 6.0);
}
