// Depths that are given, row by row.

override width: u32;
@group(0) @binding(0) var<storage, read> depths: array<f32>;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    return vec4f(4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0, 0.0, 1.0);
}

@fragment
fn depth(@builtin(position) position: vec4f) -> @builtin(frag_depth) f32 {
    return depths[u32(position.y) * width + u32(position.x)];
}
