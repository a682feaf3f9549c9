import super::super::map::depth::{depth_of_fragment};
import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_LARGEST_FLOAT16, storage_finite_texel, storage_is_float, storage_round_to_float16};

// Exponential shadow mapping: one channel, the mean E[e^(c z)] of a warped depth.
//
// Where no depth is behind the fragment, the binary test z < z_f is 1 - e^(c (z - z_f)) but for a ramp of width 1/c, and the
// mean of that needs no knowledge of z_f (Annen et al., "Exponential Shadow Maps", GI 2008; Salvi 2008). Depths behind the
// fragment count as more than one lit sample, so the clamped result is a lower bound on shadow intensity, by Markov's
// inequality: any depth behind the fragment makes it leak.
//
// A texel holds the mean itself (plain), or v = log(mean) / c in [-1, 1] (logarithmic), which spreads the error of rounding
// evenly over depth. Plain texels are filtered like any. The linear mean of v is darker than the mean that it stands for: to
// filter logarithmic texels without that, average `exponential_mean_of_texel` of the taps and write the result with
// `exponential_to_texel`. Since e^(-80) to e^80 are normal numbers with weights down to 2^-10, no maximum has to be taken out of the
// sum before.

// The largest exponents c, so that rounding in a resolve and a two-pass blur darkens by at most 1 % (float32: that means stay
// normal numbers, below which devices may flush to zero, with the weights of a usual kernel of 129 taps as well, all of which are above
// 2^-10). Larger ones make no NaN, but their results are not bounds.
//   float32: 2^-10 e^-c >= 2^-126, so c <= 116 log 2 = 80.4
//   float16, plain: e^-c >= 2^-14 (below the steps are constant), so c <= 14 log 2 = 9.70; e^c < 65504 asks for less
//   unorm16, plain: e^(c (z - 1)) is off by 3 / 2^17 while it falls to e^(-2 c), so e^(2 c) <= 0.01 2^17 / 3 and c <= 3.04
//   float16, logarithmic: v is off by 3 / 2^12, so c <= 0.01 2^12 / 3 = 13.65
//   unorm16, logarithmic: v is off by 3 / 2^16; the range of float32 asks for more
const EXPONENTIAL_LARGEST_EXPONENT: f32 = 80.0;
const EXPONENTIAL_LARGEST_EXPONENT_FLOAT16: f32 = 9.7;
const EXPONENTIAL_LARGEST_EXPONENT_UNORM16: f32 = 3.0;
const EXPONENTIAL_LARGEST_EXPONENT_FLOAT16_LOGARITHMIC: f32 = 13.6;

// Below this exponent log(mean) / c loses digits, and there is hardly a shadow.
const EXPONENTIAL_SMALLEST_EXPONENT: f32 = 1.0;

// Below e^-80.
const EXPONENTIAL_SMALLEST_MEAN: f32 = 1e-35;

// The exponent, limited as in all functions here: everything stays finite.
fn exponential_exponent(exponent: f32) -> f32 {
    return clamp(exponent, EXPONENTIAL_SMALLEST_EXPONENT, EXPONENTIAL_LARGEST_EXPONENT);
}

// The channels to average for a depth z in [-1, 1], in x.
fn exponential_channels(z: f32, exponent: f32) -> vec4f {
    return vec4f(exp(exponential_exponent(exponent) * z), 0.0, 0.0, 0.0);
}

// The texel to write for averaged channels, in x. Unorm storage holds e^(c (z - 1)), or (v + 1) / 2.
fn exponential_to_texel(channels: vec4f, stored_as: u32, exponent: f32, logarithmic: bool) -> vec4f {
    let c = exponential_exponent(exponent);
    let mean = max(channels.x, EXPONENTIAL_SMALLEST_MEAN);
    var value = mean;
    if logarithmic {
        value = clamp(log(mean) / c, -1.0, 1.0);
        value = select(fma(0.5, value, 0.5), value, storage_is_float(stored_as));
    } else if !storage_is_float(stored_as) {
        value = saturate(mean * exp(-c));
    }
    if stored_as == STORAGE_FLOAT16 {
        value = storage_round_to_float16(vec4f(min(value, STORAGE_LARGEST_FLOAT16))).x;
    }
    return vec4f(value, 0.0, 0.0, 0.0);
}

// v in [-1, 1] of a logarithmic texel.
fn exponential_logarithm_of_texel(texel: vec4f, stored_as: u32) -> f32 {
    let value = storage_finite_texel(texel, stored_as).x;
    return clamp(select(fma(2.0, value, -1.0), value, storage_is_float(stored_as)), -1.0, 1.0);
}

// E[e^(c z)] of a texel, in [0, 3e38] whatever it holds.
fn exponential_mean_of_texel(texel: vec4f, stored_as: u32, exponent: f32, logarithmic: bool) -> f32 {
    let c = exponential_exponent(exponent);
    if logarithmic {
        return exp(c * exponential_logarithm_of_texel(texel, stored_as));
    }
    let value = clamp(storage_finite_texel(texel, stored_as).x, 0.0, 3e38);
    return select(value * exp(c), value, storage_is_float(stored_as));
}

// Shadow intensity in [0, 1] of a fragment for the mean E[e^(c (z - shift))], which may be any finite number.
fn exponential_shadow_intensity(mean: f32, fragment_depth: f32, exponent: f32, shift: f32) -> f32 {
    let c = exponential_exponent(exponent);
    let own = max(exp(c * (depth_of_fragment(fragment_depth) - shift)), EXPONENTIAL_SMALLEST_MEAN);
    // The lesser of both comes first, so the quotient neither overflows nor exceeds 1.
    return saturate(1.0 - clamp(mean, 0.0, own) / own);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound.
fn exponential_shadow_intensity_of_texel(
    texel: vec4f,
    fragment_depth: f32,
    stored_as: u32,
    exponent: f32,
    logarithmic: bool,
) -> f32 {
    if logarithmic {
        let distance = exponential_logarithm_of_texel(texel, stored_as) - depth_of_fragment(fragment_depth);
        return saturate(1.0 - exp(exponential_exponent(exponent) * min(distance, 0.0)));
    }
    let shift = select(1.0, 0.0, storage_is_float(stored_as));
    return exponential_shadow_intensity(storage_finite_texel(texel, stored_as).x, fragment_depth, exponent, shift);
}
