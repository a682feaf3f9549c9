import moment_shadows::map::translucent_casters::{translucent_casters_four_moments, translucent_casters_six_moments, translucent_casters_two_moments};
import node::storage::{STORAGE};

// A caster all over the map.

struct Caster {
    centre: vec2f,
    // Both 0 where the opacity does not fade out.
    inverse_radius: vec2f,
    // Moment depth.
    depth: f32,
    opacity: f32,
    // Whether the opacity differs from texel to texel.
    hashed: u32,
    padding: u32,
}

@group(0) @binding(0) var<uniform> caster: Caster;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}

fn opacity(position: vec4f) -> f32 {
    let texel = vec2u(position.xy);
    let hashed = f32((5u * texel.x + 3u * texel.y) % 8u + 1u) / 8.0;
    let offset = (position.xy - caster.centre) * caster.inverse_radius;
    let inside = saturate(1.0 - dot(offset, offset));
    return caster.opacity * select(1.0, hashed, caster.hashed != 0u) * inside * inside;
}

@fragment
fn two_moments(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return translucent_casters_two_moments(caster.depth, opacity(position), STORAGE);
}

@fragment
fn four_moments() -> @location(0) vec4f {
    return translucent_casters_four_moments(caster.depth, STORAGE);
}

@fragment
fn four_moments_product(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return vec4f(opacity(position));
}

@fragment
fn four_moments_sum(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return opacity(position) * translucent_casters_four_moments(caster.depth, STORAGE);
}

struct Planes {
    @location(0) odd: vec4f,
    @location(1) even: vec4f,
}

@fragment
fn six_moments(@builtin(position) position: vec4f) -> Planes {
    let texels = translucent_casters_six_moments(caster.depth, opacity(position), STORAGE);
    return Planes(texels[0], texels[1]);
}
