import moment_shadows::moments::enclosed_moments::{EnclosedMoments, enclosed_moments_bounds, enclosed_moments_of_occluder, enclosed_moments_sum, enclosed_moments_to_even_texel, enclosed_moments_to_odd_texel};
import moment_shadows::bounds::hamburger6::{hamburger6_bounds};
import moment_shadows::moments::six_moments::{SixMoments, six_moments_apply_bias, six_moments_bias_of, six_moments_from_depth, six_moments_from_texels, six_moments_to_even_texel, six_moments_to_odd_texel};
import moment_shadows::map::storage::{STORAGE_UNORM16, STORAGE_UNORM8};

// Bounds of occluders with weights, stored and read again: with their ends apart, and as one distribution; and of texels as
// they are.

struct BatchInput {
    depths: array<f32, 6>,
    weights: array<f32, 6>,
    depth: f32,
    stored_as: u32,
    texels: array<vec4f, 2>,
}

struct BatchOutput {
    apart: vec2f,
    whole: vec2f,
    of_texels: vec2f,
    padding: vec2f,
    odd: vec4f,
    even: vec4f,
    whole_odd: vec4f,
    whole_even: vec4f,
}

// What a texture of the storage keeps; the modules round float16 themselves.
fn kept(texel: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_UNORM8 {
        return round(saturate(texel) * 255.0) / 255.0;
    }
    return select(texel, round(saturate(texel) * 65535.0) / 65535.0, stored_as == STORAGE_UNORM16);
}

fn batch(input: BatchInput) -> BatchOutput {
    var depths = input.depths;
    var weights = input.weights;
    var sums = enclosed_moments_of_occluder(1.0, vec2f(0.0));
    var whole = SixMoments(vec3f(0.0), vec3f(0.0));
    for (var index = 0u; index < 6u; index++) {
        let depth = depths[index];
        let shares = vec2f(select(0.0, 1.0, depth <= -1.0), select(0.0, 1.0, abs(depth) < 1.0));
        sums = enclosed_moments_sum(sums, enclosed_moments_of_occluder(depth, weights[index] * shares));
        let powers = six_moments_from_depth(clamp(depths[index], -1.0, 1.0));
        whole.odd = fma(vec3f(weights[index]), powers.odd, whole.odd);
        whole.even = fma(vec3f(weights[index]), powers.even, whole.even);
    }
    let odd = kept(enclosed_moments_to_odd_texel(sums, input.stored_as), input.stored_as);
    let even = kept(enclosed_moments_to_even_texel(sums, input.stored_as), input.stored_as);
    let whole_odd = six_moments_to_odd_texel(whole.odd, input.stored_as);
    let whole_even = six_moments_to_even_texel(whole.even, input.stored_as);
    let kept_whole = array<vec4f, 2>(kept(whole_odd, input.stored_as), kept(whole_even, input.stored_as));
    let bias = six_moments_bias_of(input.stored_as);
    let biased = six_moments_apply_bias(six_moments_from_texels(kept_whole, input.stored_as), bias);
    return BatchOutput(
        enclosed_moments_bounds(array<vec4f, 2>(odd, even), input.depth, input.stored_as),
        hamburger6_bounds(biased, input.depth, bias.alpha),
        enclosed_moments_bounds(input.texels, input.depth, input.stored_as),
        vec2f(0.0),
        odd,
        even,
        kept_whole[0],
        kept_whole[1],
    );
}
