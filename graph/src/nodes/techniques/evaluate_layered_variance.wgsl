import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers, layered_variance_choice, layered_variance_shadow_intensity_of_texel};
import node::map_texel::{map_texel};
import node::specialization::{STORAGE};
import node::technique_layers::{technique_layers};
import node::technique_receiver::{TechniqueReceiver};

fn intensity_of_layer(receiver: TechniqueReceiver, layers: LayeredVarianceLayers, layer: u32) -> f32 {
    let texel = map_texel(receiver, layer / 2u);
    return layered_variance_shadow_intensity_of_texel(texel, receiver.fragment_depth, STORAGE, layers, layer);
}

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let layers = technique_layers(receiver.layer);
    let choice = layered_variance_choice(layers, receiver.fragment_depth);
    let intensity = intensity_of_layer(receiver, layers, choice.layer);
    if choice.neighbor_share <= 0.0 {
        return intensity;
    }
    return mix(intensity, intensity_of_layer(receiver, layers, choice.neighbor), choice.neighbor_share);
}
