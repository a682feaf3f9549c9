import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::moments::four_moments::{four_moments_bias_of, four_moments_biased_from_texel};
import node::moments_lookup::{moments_lookup};
import node::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from one texel.
fn scattering_bounds(uv: vec2f, region: MapRegion, depth: f32) -> vec2f {
    let bias = four_moments_bias_of(STORAGE);
    let texel = moments_lookup(0u, region, uv, vec2f(0.0), vec2f(0.0));
    return hamburger4_bounds(four_moments_biased_from_texel(texel, STORAGE, bias), depth, bias.alpha);
}
