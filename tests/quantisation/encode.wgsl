import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::moments::four_moments::{four_moments_dequantize, four_moments_from_depth, four_moments_quantize};
import moment_shadows::map::storage::{storage_round_to_float16};

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
    let moments = mix(four_moments_from_depth(near), four_moments_from_depth(far), input.far_weight);
    let channels = four_moments_quantize(moments);
    let decoded = four_moments_dequantize(channels);
    let rounded = storage_round_to_float16(vec4f(input.value)).x;
    return BatchOutput(channels, decoded, near, rounded, vec2f(0.0));
}
