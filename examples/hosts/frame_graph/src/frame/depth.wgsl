// A depth map from numbers: one for each sample of each texel, row by row.

override width: u32;
override samples: u32;

@group(0) @binding(0) var<storage, read> depths: array<f32>;

@vertex
fn triangle(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(4.0 * corner - 1.0, 0.0, 1.0);
}

@fragment
fn depth(
    @builtin(position) position: vec4f,
    @builtin(sample_index) sample: u32,
) -> @builtin(frag_depth) f32 {
    let texel = vec2u(position.xy);
    return depths[(texel.y * width + texel.x) * samples + sample];
}
