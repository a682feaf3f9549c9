import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};
import moment_shadows::moments::four_moments::{four_moments_bias_of, four_moments_from_texel};
import node::scattering_storage::{STORAGE};

// Visibility by the filtered map of four moments.

@group(0) @binding(2) var moments_map: texture_2d_array<f32>;
@group(0) @binding(3) var moments_sampler: sampler;

// The shadow of a moment depth at a place of the map; nothing is in shadow outside the map.
fn visibility_shadow(uv: vec2f, depth: f32) -> f32 {
    let inside = all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
    let moments = four_moments_from_texel(textureSampleLevel(moments_map, moments_sampler, uv, 0u, 0.0), STORAGE);
    return select(0.0, hamburger4_shadow_intensity(moments, depth, four_moments_bias_of(STORAGE)), inside);
}
