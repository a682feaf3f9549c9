import moment_shadows::techniques::convolution::{CONVOLUTION_DAMPING, convolution_plane, convolution_receiver, convolution_shadow_intensity};
import node::map_texel::{map_texel};
import node::specialization::{LOWER_BOUND, PLANES, STORAGE, TERMS};
import node::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let place = convolution_receiver(receiver.fragment_depth, TERMS, LOWER_BOUND);
    var sum = 0.0;
    for (var plane = 0u; plane < PLANES; plane++) {
        sum += convolution_plane(map_texel(receiver, plane), STORAGE, plane, TERMS, place, CONVOLUTION_DAMPING);
    }
    return convolution_shadow_intensity(sum, TERMS, LOWER_BOUND);
}
