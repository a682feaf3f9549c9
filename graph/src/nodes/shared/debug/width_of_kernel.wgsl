import moment_shadows::shade::receiver_bias::{RECEIVER_BIAS_STANDARD_DEVIATIONS};
import node::technique_receiver::{TechniqueReceiver};
import node::views::{views};

// The standard deviation of the map's filter in texels, the lookup included, which the receiver bias is made of.
fn filter_width(view: u32, receiver: TechniqueReceiver) -> f32 {
    return views[view].receiver_bias.slope_scale / RECEIVER_BIAS_STANDARD_DEVIATIONS;
}
