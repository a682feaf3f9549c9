
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

struct Point {
    @builtin(position) position: vec4f,
}

@vertex
fn cover(@builtin(vertex_index) index: u32) -> Point {
    let stored = 0.5 * caster.depth + 0.5;
    return Point(vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, stored, 1.0));
}

fn depth_of(point: Point) -> f32 {
    return caster.depth;
}

fn opacity_of(point: Point) -> f32 {
    let texel = vec2u(point.position.xy);
    let hashed = f32((5u * texel.x + 3u * texel.y) % 8u + 1u) / 8.0;
    let offset = (point.position.xy - caster.centre) * caster.inverse_radius;
    let inside = saturate(1.0 - dot(offset, offset));
    return caster.opacity * select(1.0, hashed, caster.hashed != 0u) * inside * inside;
}
