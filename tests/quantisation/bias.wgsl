import moment_shadows::moments::{moments_apply_bias, moments_bias_of, moments_biased_from_texel, moments_from_depth, moments_from_texel, moments_to_texel};

struct BatchInput {
    moments: vec4f,
    storage: u32,
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
    let bias = moments_bias_of(input.storage);
    // Two surfaces: moments in their ranges but for the rounding of the texel.
    let valid = mix(moments_from_depth(input.moments.x), moments_from_depth(input.moments.z), input.moments.y);
    let texel = moments_to_texel(valid, input.storage);
    return BatchOutput(
        moments_apply_bias(input.moments, bias),
        bias.alpha,
        bias.second,
        bias.fourth,
        0.0,
        moments_biased_from_texel(texel, input.storage, bias),
        moments_apply_bias(moments_from_texel(texel, input.storage), bias),
    );
}
