import super::super::map::storage::{STORAGE_FLOAT16};
import super::super::moments::four_moments::{FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16, FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16, FourMomentsBias, four_moments_apply_bias, four_moments_biased_from_texel, four_moments_quantize, four_moments_to_texel};

// Rounding of four valid moments to a texel whose moments are valid too.
//
// Rounding every channel to the nearest number errs to all sides, and a moment bias has to bring back the worst of it. Of the 16 texels
// around the exact channels this takes one whose moments are possible, and of these the one nearest to the boundary of the possible:
// that with the smallest determinant of the Hankel matrix. The bias then has little to cover.

// The share of the bias with which the moments of a texel are valid; the rest is for filters and the evaluation.
const INWARD_ROUNDING_SHARE: f32 = 0.33333334;

// Where no texel around is valid, moments are moved towards the target of the bias by so many times its step, and every channel is rounded
// to the nearest number: that is more than this rounding needs (`moment-shadows-lab bias`, one rounding).
const INWARD_ROUNDING_MOVE: f32 = 3.7;

// Keys of invalid texels are at least this.
const INWARD_ROUNDING_INVALID: u32 = 0x80000000u;

// The least key of four texels with the odd moments b1 and b3 in `odd`, b2 in `second`, and b4 - b2^2 in `excess`. A key is the bits of
// the determinant, of which the last four are the texel's number; those of positive floats are in their order.
fn inward_rounding_least_key(odd: vec2f, second: vec4f, excess: vec4f, numbers: vec4u) -> u32 {
    let variance = second - odd.x * odd.x;
    let covariance = fma(vec4f(-odd.x), second, vec4f(odd.y));
    let determinant = fma(variance, excess, -covariance * covariance);
    let keys = (bitcast<vec4u>(determinant) & vec4u(0xfffffff0u)) | numbers;
    return min(min(keys.x, keys.y), min(keys.z, keys.w));
}

// Which of the 16 texels between `low` and `high` is the best: four bits say of which channels the higher number is taken. With the bit of
// INWARD_ROUNDING_INVALID none is valid.
fn inward_rounding_best(low: vec4f, high: vec4f, bias: FourMomentsBias, stored_as: u32) -> u32 {
    // Odd moments are those of the channels x and z, even ones of y and w.
    let b0 = four_moments_biased_from_texel(low, stored_as, bias);
    let b1 = four_moments_biased_from_texel(vec4f(high.xy, low.zw), stored_as, bias);
    let b2 = four_moments_biased_from_texel(vec4f(low.xy, high.zw), stored_as, bias);
    let b3 = four_moments_biased_from_texel(high, stored_as, bias);
    let second = vec4f(b0.y, b1.y, b2.y, b3.y);
    let excess = fma(-second, second, vec4f(b0.w, b1.w, b2.w, b3.w));
    // The matrix is positive definite if this and its determinant are positive.
    let invalid = bitcast<vec4u>(excess) & vec4u(INWARD_ROUNDING_INVALID);
    let numbers = vec4u(0u, 2u, 8u, 10u) | invalid;
    let first = min(
        inward_rounding_least_key(b0.xz, second, excess, numbers),
        inward_rounding_least_key(b1.xz, second, excess, numbers | vec4u(1u)),
    );
    return min(first, min(
        inward_rounding_least_key(b2.xz, second, excess, numbers | vec4u(4u)),
        inward_rounding_least_key(b3.xz, second, excess, numbers | vec4u(5u)),
    ));
}

// The texel of a storage for valid moments: unorm16 or float16.
fn inward_rounding_texel(b: vec4f, stored_as: u32) -> vec4f {
    let is_float = stored_as == STORAGE_FLOAT16;
    let channels = saturate(four_moments_quantize(b));
    var bias = FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16;
    var low = floor(channels * 65535.0) / 65535.0;
    var high = min(low + 1.0 / 65535.0, vec4f(1.0));
    if is_float {
        bias = FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16;
        // Half precision is finest around zero, so the channels are centred there. Its spacing is 10 bits below the leading one, and
        // 2^-24 below 2^-14.
        let centred = channels - 0.5;
        let leading = bitcast<vec4u>(max(abs(centred), vec4f(6.103515625e-5))) & vec4u(0x7f800000u);
        let spacing = bitcast<vec4f>(leading) * 0.0009765625;
        low = floor(centred / spacing) * spacing;
        high = min(low + spacing, vec4f(0.5));
    }
    let valid = FourMomentsBias(INWARD_ROUNDING_SHARE * bias.alpha, bias.second, bias.fourth);
    let best = inward_rounding_best(low, high, valid, stored_as);
    if best < INWARD_ROUNDING_INVALID {
        return select(low, high, (vec4u(best) & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u));
    }
    let towards = FourMomentsBias(INWARD_ROUNDING_MOVE * bias.alpha, bias.second, bias.fourth);
    return four_moments_to_texel(four_moments_apply_bias(b, towards), stored_as);
}
