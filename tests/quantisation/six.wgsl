import moment_shadows::moments::six_moments::{SixMoments, SIX_MOMENTS_EVEN_BASIS, SIX_MOMENTS_EVEN_OFFSET, SIX_MOMENTS_ODD_BASIS, SIX_MOMENTS_ODD_OFFSET, six_moments_affine, six_moments_apply_bias, six_moments_bias_of, six_moments_from_texels, six_moments_to_even_texel, six_moments_to_odd_texel};

// Moments, and the channels of two texels.
struct BatchInput {
    odd: vec3f,
    stored_as: u32,
    even: vec3f,
    padding: u32,
    odd_texel: vec3f,
    padding_of_odd: u32,
    even_texel: vec3f,
    padding_of_even: u32,
}

struct BatchOutput {
    // The channels of the moments, not clamped; alpha and the first even moment of the bias' target.
    odd_channels: vec3f,
    alpha: f32,
    even_channels: vec3f,
    second: f32,
    // The moments from the texels of the moments; the target's others.
    odd_decoded: vec3f,
    fourth: f32,
    even_decoded: vec3f,
    sixth: f32,
    // The given moments, biased.
    odd_biased: vec3f,
    padding: f32,
    even_biased: vec3f,
    padding_of_biased: f32,
    // The biased moments from the given texels.
    odd_of_texels: vec3f,
    padding_of_odd: f32,
    even_of_texels: vec3f,
    padding_of_even: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    let moments = SixMoments(input.odd, input.even);
    let bias = six_moments_bias_of(input.stored_as);
    let odd = six_moments_to_odd_texel(input.odd, input.stored_as);
    let encoded = array<vec4f, 2>(odd, six_moments_to_even_texel(input.even, input.stored_as));
    let decoded = six_moments_from_texels(encoded, input.stored_as);
    let biased = six_moments_apply_bias(moments, bias);
    let texels = array<vec4f, 2>(vec4f(input.odd_texel, 1.0), vec4f(input.even_texel, 1.0));
    let of_texels = six_moments_apply_bias(six_moments_from_texels(texels, input.stored_as), bias);
    return BatchOutput(
        six_moments_affine(SIX_MOMENTS_ODD_BASIS, input.odd, SIX_MOMENTS_ODD_OFFSET),
        bias.alpha,
        six_moments_affine(SIX_MOMENTS_EVEN_BASIS, input.even, SIX_MOMENTS_EVEN_OFFSET),
        bias.even.x,
        decoded.odd,
        bias.even.y,
        decoded.even,
        bias.even.z,
        biased.odd,
        0.0,
        biased.even,
        0.0,
        of_texels.odd,
        0.0,
        of_texels.even,
        0.0,
    );
}
