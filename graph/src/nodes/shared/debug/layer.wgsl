import node::debug_colours::{debug_hue};
import node::technique_layer::{technique_layer};
import node::technique_receiver::{TechniqueReceiver};

// A hue per layer of a layered variance shadow map: of the last one that shades a pixel.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    return debug_hue(technique_layer(receiver));
}
