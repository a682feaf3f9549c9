import moment_shadows::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::moments::{moments_dequantize, moments_from_depth, moments_quantize};
import moment_shadows::storage::{storage_round_to_float16};

// Two stored depths and their shares, encoded and decoded; and the rounding to float16.
struct BatchInput {
    near: f32,
    far: f32,
    far_weight: f32,
    value: f32,
}

struct BatchOutput {
    channels: vec4f,
    decoded: vec4f,
    near: f32,
    rounded: f32,
    padding: vec2f,
}

fn batch(input: BatchInput) -> BatchOutput {
    // Stored depth is moment depth already.
    let conversion = DepthConversion(vec2f(-1.0, 1.0), vec2f(1.0), 0.5, 0.5, vec2f(0.0));
    let near = depth_to_moment_depth(input.near, conversion);
    let far = depth_to_moment_depth(input.far, conversion);
    let moments = mix(moments_from_depth(near), moments_from_depth(far), input.far_weight);
    let channels = moments_quantize(moments);
    let decoded = moments_dequantize(channels);
    let rounded = storage_round_to_float16(vec4f(input.value)).x;
    return BatchOutput(channels, decoded, near, rounded, vec2f(0.0));
}
