// Copies one band of rows of a multisampled depth texture into a buffer, the samples of a texel together.

struct Band {
    first_row: u32,
}

@group(0) @binding(0) var depth: texture_depth_multisampled_2d;
@group(0) @binding(1) var<storage, read_write> values: array<f32>;
@group(0) @binding(2) var<uniform> band: Band;

@compute @workgroup_size(64)
fn read(@builtin(global_invocation_id) id: vec3u) {
    let width = textureDimensions(depth).x;
    let samples = textureNumSamples(depth);
    let row = band.first_row + id.y;
    if id.x < width && row < textureDimensions(depth).y {
        for (var sample = 0u; sample < samples; sample++) {
            values[(id.y * width + id.x) * samples + sample] = textureLoad(depth, vec2u(id.x, row), sample);
        }
    }
}
