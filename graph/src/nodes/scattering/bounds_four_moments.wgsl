import moment_shadows::hamburger::{hamburger_bounds};
import moment_shadows::map_region::{MapRegion};
import moment_shadows::moments::{moments_bias_of, moments_biased_from_texel};
import moment_shadows::moments_lookup::{moments_lookup};
import moment_shadows::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from one texel.
fn scattering_bounds(uv: vec2f, region: MapRegion, depth: f32) -> vec2f {
    let bias = moments_bias_of(STORAGE);
    let texel = moments_lookup(0u, region, uv, vec2f(0.0), vec2f(0.0));
    return hamburger_bounds(moments_biased_from_texel(texel, STORAGE, bias), depth, bias.alpha);
}
