import moment_shadows::techniques::exponential::{exponential_mean_of_texel, exponential_to_texel};
import node::specialization::{EXPONENT, STORAGE};

// Logarithms of means: a filter averages the means.

fn filtering_value(texel: vec4f) -> vec4f {
    return vec4f(exponential_mean_of_texel(texel, STORAGE, EXPONENT, true), 0.0, 0.0, 0.0);
}

fn filtering_texel(value: vec4f) -> vec4f {
    return exponential_to_texel(value, STORAGE, EXPONENT, true);
}
