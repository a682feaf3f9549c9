import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
import moment_shadows::moments::four_moments::{four_moments_bias_of, four_moments_biased_from_texel};
import node::scattering_lookup::{scattering_lookup};
import node::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from one texel.
fn scattering_bounds(uv: vec2f, depth: f32) -> vec2f {
    let bias = four_moments_bias_of(STORAGE);
    let texel = scattering_lookup(0u, uv);
    return hamburger4_bounds(four_moments_biased_from_texel(texel, STORAGE, bias), depth, bias.alpha);
}
