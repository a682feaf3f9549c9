import moment_shadows::moments::four_moments::{four_moments_apply_bias, four_moments_bias_of, four_moments_biased_from_texel, four_moments_from_depth, four_moments_from_texel, four_moments_to_texel};

struct BatchInput {
    moments: vec4f,
    stored_as: u32,
    padding: vec3u,
}

struct BatchOutput {
    biased: vec4f,
    alpha: f32,
    second: f32,
    fourth: f32,
    padding: f32,
    // What a texel of the moments gives: bias and all in one step, and one step after the other.
    at_once: vec4f,
    in_turn: vec4f,
}

fn batch(input: BatchInput) -> BatchOutput {
    let bias = four_moments_bias_of(input.stored_as);
    // Two surfaces: moments in their ranges but for the rounding of the texel.
    let valid = mix(four_moments_from_depth(input.moments.x), four_moments_from_depth(input.moments.z), input.moments.y);
    let texel = four_moments_to_texel(valid, input.stored_as);
    return BatchOutput(
        four_moments_apply_bias(input.moments, bias),
        bias.alpha,
        bias.second,
        bias.fourth,
        0.0,
        four_moments_biased_from_texel(texel, input.stored_as, bias),
        four_moments_apply_bias(four_moments_from_texel(texel, input.stored_as), bias),
    );
}
