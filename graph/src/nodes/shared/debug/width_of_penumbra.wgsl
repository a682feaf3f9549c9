import node::technique_blockers::{technique_blockers};
import node::technique_receiver::{TechniqueReceiver};

// Half the width in texels of what is filtered: as wide as the light appears through the blockers.
fn filter_width(view: u32, receiver: TechniqueReceiver) -> f32 {
    return technique_blockers(receiver).z;
}
