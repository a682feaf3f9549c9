import moment_shadows::bounds::hamburger4::{hamburger4_bounds, hamburger4_shadow_intensity};
import moment_shadows::moments::four_moments::{four_moments_apply_bias, four_moments_bias_of, four_moments_clamp, four_moments_from_depth, four_moments_from_texel, four_moments_to_texel};
import moment_shadows::map::storage::{STORAGE_FLOAT16, STORAGE_UNORM16};

// One or two surfaces, encoded, rounded to a storage as a texture would hold them, decoded and evaluated.
struct BatchInput {
    near: f32,
    far: f32,
    far_weight: f32,
    fragment_depth: f32,
    stored_as: u32,
    padding: u32,
}

struct BatchOutput {
    biased: vec4f,
    // Displayed intensity, and both bounds.
    intensity: f32,
    lower: f32,
    upper: f32,
    padding: f32,
}

fn stored(texel: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_UNORM16 {
        return vec4f(unpack2x16unorm(pack2x16unorm(texel.xy)), unpack2x16unorm(pack2x16unorm(texel.zw)));
    }
    if stored_as == STORAGE_FLOAT16 {
        return vec4f(unpack2x16float(pack2x16float(texel.xy)), unpack2x16float(pack2x16float(texel.zw)));
    }
    return texel;
}

fn batch(input: BatchInput) -> BatchOutput {
    let moments = mix(four_moments_from_depth(input.near), four_moments_from_depth(input.far), input.far_weight);
    let texel = stored(four_moments_to_texel(moments, input.stored_as), input.stored_as);
    let decoded = four_moments_from_texel(texel, input.stored_as);
    let bias = four_moments_bias_of(input.stored_as);
    let biased = four_moments_apply_bias(four_moments_clamp(decoded), bias);
    let bounds = hamburger4_bounds(biased, input.fragment_depth, bias.alpha);
    let intensity = hamburger4_shadow_intensity(decoded, input.fragment_depth, bias);
    return BatchOutput(biased, intensity, bounds.x, bounds.y, 0.0);
}
