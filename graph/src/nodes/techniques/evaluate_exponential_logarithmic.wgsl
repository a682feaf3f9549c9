import moment_shadows::techniques::exponential::{exponential_mean_of_texel, exponential_shadow_intensity};
import moment_shadows::map::map_region::{map_region_place};
import node::moments_lookup::{moments_map};
import node::specialization::{EXPONENT, STORAGE};
import node::technique_receiver::{TechniqueReceiver};

// Texels hold logarithms: they are decoded before they are blended.

fn mean_at(texel: vec2i, layer: u32) -> f32 {
    return exponential_mean_of_texel(textureLoad(moments_map, texel, layer, 0), STORAGE, EXPONENT, true);
}

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let place = map_region_place(receiver.region, receiver.uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(receiver.region.origin + receiver.region.extent) - 1);
    let top = mix(mean_at(low, receiver.layer), mean_at(vec2i(high.x, low.y), receiver.layer), weight.x);
    let bottom = mix(mean_at(vec2i(low.x, high.y), receiver.layer), mean_at(high, receiver.layer), weight.x);
    return exponential_shadow_intensity(mix(top, bottom, weight.y), receiver.fragment_depth, EXPONENT, 0.0);
}
