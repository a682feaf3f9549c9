import moment_shadows::moments::enclosed_moments::{enclosed_moments_bounds};
import node::scattering_lookup::{scattering_lookup};
import node::specialization::{STORAGE};

// Both bounds of the shadow of a depth at a place of the integrated map, from a texel of each of its planes.
fn scattering_bounds(uv: vec2f, depth: f32) -> vec2f {
    let odd = scattering_lookup(0u, uv);
    let even = scattering_lookup(1u, uv);
    return enclosed_moments_bounds(array<vec4f, 2>(odd, even), depth, STORAGE);
}
