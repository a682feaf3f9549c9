import node::debug_colours::{debug_ramp};
import node::technique_receiver::{TechniqueReceiver};

// Texels of the map along the longer side of a pixel: blue at an eighth, green at one, red at eight.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    let texels = max(length(receiver.difference_x), length(receiver.difference_y));
    return debug_ramp(log2(clamp(texels, 0.125, 8.0)) / 6.0 + 0.5);
}
