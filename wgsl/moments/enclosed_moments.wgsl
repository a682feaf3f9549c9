import super::super::bounds::hamburger6::{hamburger6_bounds_at, hamburger6_factor};
import super::super::moments::six_moments::{SIX_MOMENTS_EVEN_BASIS, SIX_MOMENTS_EVEN_OFFSET, SIX_MOMENTS_ODD_BASIS, SIX_MOMENTS_ODD_OFFSET, SixMoments, SixMomentsBias, six_moments_affine, six_moments_apply_bias, six_moments_bias_of, six_moments_biased_from_channels, six_moments_from_channels, six_moments_from_depth, six_moments_middle};
import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_UNORM8, storage_is_float, storage_round_to_float16};

// Six moments of the occluders between the ends of a range, with the weights of what lies before and behind it kept apart.
//
// In rectified coordinates much of a view ray has no occluder at all, or one that shadows every view ray of the frustum. As
// depths at the very ends of the range, these take part in the moment problem, although their effect is known exactly, and
// loosen the bounds of everything else. Six moments leave the fourth channel of both texels free, which is room for both
// weights. The stored values are linear in all of this and commute with filtering and prefix sums.

// Weighted sums over the occluders of a texel. All weights together are one.
struct EnclosedMoments {
    // The moments of occluders at depths between -1 and 1.
    moments: SixMoments,
    // The weight of these occluders.
    weight: f32,
    // The weight of occluders at -1 and before. The rest, up to one, is behind the range: no occluder.
    front: f32,
}

// The smallest weight between the ends: below it the depths in between do not matter, and float16 has few digits left for
// them.
const ENCLOSED_MOMENTS_SMALLEST_WEIGHT: f32 = 0.001953125;

// The moment bias of unorm8, which holds six moments in these maps alone: means of many texels, rounded once. With the limit below it
// covers that rounding for 99.9 % of distributions of six occluders, and half of it for 99 %.
const ENCLOSED_MOMENTS_ALPHA_UNORM8: f32 = 0.012;

// The largest moment bias. Where it leaves rounding uncovered, little weight is at stake; a larger one would make the depths of thin
// shadows count for nothing (`fence-and-foliage` under a sun at 15 degrees, unorm8: 0.81 % error with 0.5, 0.53 % with this).
const ENCLOSED_MOMENTS_LARGEST_ALPHA: f32 = 0.05;

// The sums of one occluder: x of its weight lies in front of the range, y at its depth in [-1, 1].
fn enclosed_moments_of_occluder(depth: f32, weights: vec2f) -> EnclosedMoments {
    let powers = six_moments_from_depth(depth);
    return EnclosedMoments(SixMoments(weights.y * powers.odd, weights.y * powers.even), weights.y, weights.x);
}

// The sums of two sets of occluders together.
fn enclosed_moments_sum(a: EnclosedMoments, b: EnclosedMoments) -> EnclosedMoments {
    let moments = SixMoments(a.moments.odd + b.moments.odd, a.moments.even + b.moments.even);
    return EnclosedMoments(moments, a.weight + b.weight, a.front + b.front);
}

// A texel of three channels of the optimised basis times the weight, and one more channel.
fn enclosed_moments_texel(channels: vec3f, last: f32, weight: f32, stored_as: u32) -> vec4f {
    let middle = six_moments_middle(stored_as);
    let inside = saturate(weight);
    let texel = vec4f(clamp(channels, vec3f(-middle * inside), vec3f((1.0 - middle) * inside)), saturate(last));
    if stored_as == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    return texel;
}

// The first texel to write in the storage: the odd moments, and the weight of what does not lie in front of the range.
// Moments of whole distributions, as `six_moments_to_odd_texel` writes them, have the same form.
fn enclosed_moments_to_odd_texel(sums: EnclosedMoments, stored_as: u32) -> vec4f {
    let offset = sums.weight * (SIX_MOMENTS_ODD_OFFSET - six_moments_middle(stored_as));
    let channels = six_moments_affine(SIX_MOMENTS_ODD_BASIS, sums.moments.odd, offset);
    return enclosed_moments_texel(channels, 1.0 - sums.front, sums.weight, stored_as);
}

// The second texel to write in the storage: the even moments, and the weight between the ends.
fn enclosed_moments_to_even_texel(sums: EnclosedMoments, stored_as: u32) -> vec4f {
    let offset = sums.weight * (SIX_MOMENTS_EVEN_OFFSET - six_moments_middle(stored_as));
    let channels = six_moments_affine(SIX_MOMENTS_EVEN_BASIS, sums.moments.even, offset);
    return enclosed_moments_texel(channels, sums.weight, sums.weight, stored_as);
}

// The moment bias of means. Floats keep that of the storage whatever the weight is, as they are finest around zero; the step
// of other storages does not shrink for small weights.
fn enclosed_moments_bias(weight: f32, stored_as: u32) -> SixMomentsBias {
    let bias = six_moments_bias_of(stored_as);
    let alpha = select(bias.alpha, ENCLOSED_MOMENTS_ALPHA_UNORM8, stored_as == STORAGE_UNORM8);
    let scale = select(1.0 / max(weight, ENCLOSED_MOMENTS_SMALLEST_WEIGHT), 1.0, storage_is_float(stored_as));
    return SixMomentsBias(bias.even, min(alpha * scale, ENCLOSED_MOMENTS_LARGEST_ALPHA));
}

// The biased moments of a filtered texel's occluders between the ends, as means over them alone. Weights below
// `ENCLOSED_MOMENTS_SMALLEST_WEIGHT` count as that.
fn enclosed_moments_biased(texels: array<vec4f, 2>, weight: f32, stored_as: u32) -> SixMoments {
    let scale = 1.0 / max(weight, ENCLOSED_MOMENTS_SMALLEST_WEIGHT);
    // From 0 to 1 for all storages: clamping is free there, and only float32 has more digits around one half less.
    let middle = select(six_moments_middle(stored_as), 0.0, stored_as == STORAGE_FLOAT32);
    var odd = saturate(fma(vec3f(scale), texels[0].xyz, vec3f(middle)));
    var even = saturate(fma(vec3f(scale), texels[1].xyz, vec3f(middle)));
    if stored_as == STORAGE_FLOAT32 {
        odd = clamp(scale * texels[0].xyz, vec3f(-0.5), vec3f(0.5));
        even = clamp(scale * texels[1].xyz, vec3f(-0.5), vec3f(0.5));
    }
    if stored_as == STORAGE_FLOAT16 {
        return six_moments_biased_from_channels(odd, even, 0.0, six_moments_bias_of(stored_as));
    }
    let moments = six_moments_from_channels(odd, even, six_moments_middle(stored_as));
    return six_moments_apply_bias(moments, enclosed_moments_bias(weight, stored_as));
}

// Whether all channels of a pair of texels are finite. NaN and infinities are found by their bits: a compiler may assume that
// neither occurs.
fn enclosed_moments_are_finite(texels: array<vec4f, 2>, stored_as: u32) -> bool {
    // A sum of numbers near 1, unless something is broken.
    let sum = dot(texels[0] + texels[1], vec4f(1.0));
    return !storage_is_float(stored_as) || (bitcast<u32>(sum) & 0x7f800000u) != 0x7f800000u;
}

// Bounds of the shadow at a depth: x = how much of the weight is certainly before it, y = how much may be. Both in [0, 1] for all
// texels, filtered or broken, of which those with NaN or infinities cast no shadow; depths in [-1, 1].
fn enclosed_moments_bounds(texels: array<vec4f, 2>, depth: f32, stored_as: u32) -> vec2f {
    let weight = saturate(texels[1].w);
    let front = min(saturate(1.0 - texels[0].w), 1.0 - weight);
    let alpha = enclosed_moments_bias(weight, stored_as).alpha;
    let biased = enclosed_moments_biased(texels, weight, stored_as);
    let bounds = hamburger6_bounds_at(hamburger6_factor(biased, alpha), depth - biased.odd.x, alpha);
    let known = weight >= ENCLOSED_MOMENTS_SMALLEST_WEIGHT;
    let shadow = fma(select(vec2f(0.0, 1.0), bounds, known), vec2f(weight), vec2f(front));
    return select(vec2f(0.0), shadow, enclosed_moments_are_finite(texels, stored_as));
}
