import node::debug_colours::{debug_ramp};
import node::filter_width::{filter_width};
import node::technique_receiver::{TechniqueReceiver};

// The width of the filter in pixels: blue at a quarter, green at four, red at 64.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    let texels = max(length(receiver.difference_x), length(receiver.difference_y));
    let pixels = filter_width(view, receiver) / max(texels, 1e-6);
    return debug_ramp((log2(clamp(pixels, 0.25, 64.0)) + 2.0) / 8.0);
}
