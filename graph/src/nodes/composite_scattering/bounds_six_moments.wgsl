import moment_shadows::moments::enclosed_moments::{enclosed_moments_bounds};
import moment_shadows::map::map_region::{MapRegion};
import node::moments_lookup::{moments_lookup};
import node::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from a texel of each of its planes.
fn scattering_bounds(uv: vec2f, region: MapRegion, depth: f32) -> vec2f {
    let odd = moments_lookup(0u, region, uv, vec2f(0.0), vec2f(0.0));
    let even = moments_lookup(1u, region, uv, vec2f(0.0), vec2f(0.0));
    return enclosed_moments_bounds(array<vec4f, 2>(odd, even), depth, STORAGE);
}
