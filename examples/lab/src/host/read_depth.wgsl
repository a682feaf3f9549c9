// Copies one band of rows of a single-sampled depth texture into a buffer, as the floats that a shader sees.

struct Band {
    first_row: u32,
}

@group(0) @binding(0) var depth: texture_depth_2d;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@group(0) @binding(2) var<uniform> band: Band;

@compute @workgroup_size(64)
fn read(@builtin(global_invocation_id) id: vec3u) {
    let width = textureDimensions(depth).x;
    let row = band.first_row + id.y;
    if id.x < width && row < textureDimensions(depth).y {
        values[id.y * width + id.x] = textureLoad(depth, vec2u(id.x, row), 0);
    }
}
