// Copies one band of rows of a depth texture into a buffer, the samples of a texel together, as the floats that a shader sees.

struct Band {
    first_row: u32,
    samples: u32,
}

// `texture_depth_2d` where a texel has one sample, whose number is that of the mip level.
@group(0) @binding(0) var depth: texture_depth_multisampled_2d;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@group(0) @binding(2) var<uniform> band: Band;

@compute @workgroup_size(64)
fn copy_band(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(depth);
    let row = band.first_row + id.y;
    if id.x < size.x && row < size.y {
        for (var sample = 0u; sample < band.samples; sample++) {
            let index = (id.y * size.x + id.x) * band.samples + sample;
            values[index] = textureLoad(depth, vec2u(id.x, row), sample);
        }
    }
}
