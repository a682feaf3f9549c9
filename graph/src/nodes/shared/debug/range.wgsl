import node::technique_receiver::{TechniqueReceiver};

// Where a surface lies in the map's range of depth: black at its near end, white at the far end; red before it, blue beyond.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    // Surfaces beyond the far end were moved there, but for what depths are rounded by.
    if receiver.depth >= 0.999 {
        return vec3f(0.3, 0.4, 1.0);
    }
    return select(vec3f(0.5 * receiver.depth + 0.5), vec3f(1.0, 0.2, 0.1), receiver.depth < -1.001);
}
