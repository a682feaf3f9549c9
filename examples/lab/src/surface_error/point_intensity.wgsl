import moment_shadows::moments::four_moments::{FourMomentsBias};
import node::technique::{technique_shadow_intensity};
import node::technique_receiver::{TechniqueReceiver};

// By the technique, as the library biases it.
fn point_intensity(receiver: TechniqueReceiver, moment_bias: FourMomentsBias) -> f32 {
    return technique_shadow_intensity(receiver);
}
