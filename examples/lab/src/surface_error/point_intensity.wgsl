import moment_shadows::moments::{MomentBias};
import moment_shadows::technique::{technique_shadow_intensity};
import moment_shadows::technique_receiver::{TechniqueReceiver};

// By the technique, as the library biases it.
fn point_intensity(receiver: TechniqueReceiver, moment_bias: MomentBias) -> f32 {
    return technique_shadow_intensity(receiver);
}
