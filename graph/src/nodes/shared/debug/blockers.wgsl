import node::technique_blockers::{technique_blockers};
import node::technique_receiver::{TechniqueReceiver};

// The mean depth of what blocks the light, as far as the search finds: black at the near end of the range, white at the far end;
// blue where less than a hundredth is blocked.
fn debug_colour(view: u32, receiver: TechniqueReceiver) -> vec3f {
    let blockers = technique_blockers(receiver);
    return select(vec3f(0.5 * blockers.y + 0.5), vec3f(0.0, 0.0, 0.6), blockers.x < 0.01);
}
