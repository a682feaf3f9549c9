import moment_shadows::hamburger::{hamburger_shadow_intensity};
import moment_shadows::moments::{moments_bias_of, moments_from_texel};
import moment_shadows::scattering_storage::{STORAGE};

// Visibility by the filtered map of four moments.

@group(0) @binding(2) var moments_map: texture_2d_array<f32>;
@group(0) @binding(3) var moments_sampler: sampler;

// The shadow of a moment depth at a place of the map; outside of it there is none.
fn visibility_shadow(uv: vec2f, depth: f32) -> f32 {
    let inside = all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
    let moments = moments_from_texel(textureSampleLevel(moments_map, moments_sampler, uv, 0u, 0.0), STORAGE);
    return select(0.0, hamburger_shadow_intensity(moments, depth, moments_bias_of(STORAGE)), inside);
}
