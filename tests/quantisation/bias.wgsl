import moment_shadows::moments::{moments_apply_bias, moments_bias_of};

struct BatchInput {
    moments: vec4f,
    storage: u32,
    padding: vec3u,
}

struct BatchOutput {
    biased: vec4f,
    alpha: f32,
    beta: f32,
    padding: vec2f,
}

fn batch(input: BatchInput) -> BatchOutput {
    let bias = moments_bias_of(input.storage);
    return BatchOutput(moments_apply_bias(input.moments, bias), bias.alpha, bias.beta, vec2f(0.0));
}
