import node::debug_colours::{debug_hue};
import node::technique_layer::{technique_layer};
import node::technique_receiver::{TechniqueReceiver};

// A hue per layer of a layered variance shadow map, and of two where they overlap.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    let layer = technique_layer(receiver);
    return debug_hue(u32(layer.x)) * (1.0 - layer.z) + debug_hue(u32(layer.y)) * layer.z;
}
