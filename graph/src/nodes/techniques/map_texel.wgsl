import node::moments_lookup::{moments_lookup};
import node::specialization::{PLANES};
import node::technique_receiver::{TechniqueReceiver};

// The filtered texel of a plane of the map at a receiver.
fn map_texel(receiver: TechniqueReceiver, plane: u32) -> vec4f {
    return moments_lookup(receiver.layer * PLANES + plane, receiver.region, receiver.uv, receiver.difference_x, receiver.difference_y);
}
