import moment_shadows::hamburger6::{hamburger6_bounds};
import moment_shadows::map_region::{MapRegion};
import moment_shadows::moments_lookup::{moments_lookup};
import moment_shadows::six_moments::{six_moments_apply_bias, six_moments_bias_of, six_moments_from_texels};
import moment_shadows::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from a texel of each of its planes.
fn scattering_bounds(uv: vec2f, region: MapRegion, depth: f32) -> vec2f {
    let bias = six_moments_bias_of(STORAGE);
    let odd = moments_lookup(0u, region, uv, vec2f(0.0), vec2f(0.0));
    let even = moments_lookup(1u, region, uv, vec2f(0.0), vec2f(0.0));
    let moments = six_moments_from_texels(array<vec4f, 2>(odd, even), STORAGE);
    return hamburger6_bounds(six_moments_apply_bias(moments, bias), depth, bias.alpha);
}
