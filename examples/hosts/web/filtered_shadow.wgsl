import moment_shadows::bounds::hamburger4::hamburger4_shadow_intensity_of_texel;
import moment_shadows::map::storage::STORAGE_FLOAT16;
import moment_shadows::shade::leak_reduction::leak_reduction_full_shadow;
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_plane, receiver_bias_step};

// What a material of three.js asks a filtered map: how much of a light's shadow falls on a place, from 0 to 1.
//
// `texel` is the map at that place, filtered. The place has x and y in texels and moment depth in z; `across` and `down` are how it
// changes to the next pixel.
fn filtered_shadow(texel: vec4f, place: vec3f, across: vec3f, down: vec3f, bias: ReceiverBias) -> f32 {
    let slope = length(receiver_bias_plane(across, down));
    let depth = place.z - receiver_bias_step(bias, place.z) - receiver_bias_depth(bias, slope);
    return leak_reduction_full_shadow(hamburger4_shadow_intensity_of_texel(texel, depth, STORAGE_FLOAT16), 0.98);
}
