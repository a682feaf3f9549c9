import node::debug_colours::{debug_hue};
import node::technique_receiver::{TechniqueReceiver};

// A hue per view: a cascade, a face, a spot.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    return debug_hue(view);
}
