import super::super::moments::four_moments::{FourMomentsBias, four_moments_from_depth, four_moments_to_texel};
import super::super::moments::six_moments::{SixMomentsBias, six_moments_channels, six_moments_to_texel};
import super::super::moments::two_moments::{two_moments_from_depth, two_moments_to_texel};

// Translucent casters: what is blended into a map of moments, and what that costs.
//
// A caster of opacity a keeps the share a of the light and lets 1 - a pass. Blended as a * texel + (1 - a) * map, far to near from
// the light and in front of opaque casters only, moments become those of the transmittance: the weight of a caster is its opacity
// times the transmittance in front of it. The bounds then are bounds on 1 - transmittance (Peters et al., JCGT 6(1) 2017).
// All storages hold affine images of the moments, which blend as the moments themselves do.

// The most casters over each other that a search covered.
const TRANSLUCENT_CASTERS_MOST_BLENDS: u32 = 64u;

// Every blend rounds once more. Errors that have nothing to do with each other add up as the root of their number, those of casters
// that are alike as their number; this much of the bias of a map for either covers what a search finds for 99.999 % of clouds, panes
// and mixtures of both (`moment-shadows-lab bias --blends`). Each rounding is to the nearest: a device that rounds down asks for more.
const TRANSLUCENT_CASTERS_BIAS_PER_ROOT: f32 = 0.35;
const TRANSLUCENT_CASTERS_BIAS_PER_BLEND: f32 = 0.1;

// The factor of a bias for so many casters over each other.
fn translucent_casters_bias_growth(blends: u32) -> f32 {
    let count = f32(min(blends, TRANSLUCENT_CASTERS_MOST_BLENDS));
    return fma(TRANSLUCENT_CASTERS_BIAS_PER_BLEND, count, fma(TRANSLUCENT_CASTERS_BIAS_PER_ROOT, sqrt(count), 1.0));
}

// The bias of four moments for so many casters over each other.
fn translucent_casters_four_moments_bias(bias: FourMomentsBias, blends: u32) -> FourMomentsBias {
    return FourMomentsBias(bias.alpha * translucent_casters_bias_growth(blends), bias.second, bias.fourth);
}

// The bias of six moments for so many casters over each other.
fn translucent_casters_six_moments_bias(bias: SixMomentsBias, blends: u32) -> SixMomentsBias {
    return SixMomentsBias(bias.even, bias.alpha * translucent_casters_bias_growth(blends));
}

// The smallest variance of two moments for so many casters over each other.
fn translucent_casters_smallest_variance(variance: f32, blends: u32) -> f32 {
    return variance * translucent_casters_bias_growth(blends);
}

// What a fragment at a moment depth in [-1, 1] writes into a map of two moments: the opacity is the fourth channel, which such a map
// does not have, so that it is blended as any colour is.
fn translucent_casters_two_moments(z: f32, opacity: f32, stored_as: u32) -> vec4f {
    return vec4f(two_moments_to_texel(two_moments_from_depth(z), stored_as).xy, 0.0, opacity);
}

// The same for a map of four moments. All four channels are moments, so the opacity is not among them: it is the blend constant, or
// vec4f(opacity) as a second source; or a first draw writes vec4f(opacity) and a second one this times the opacity.
fn translucent_casters_four_moments(z: f32, stored_as: u32) -> vec4f {
    return four_moments_to_texel(four_moments_from_depth(z), stored_as);
}

// The same for both texture layers of a map of six moments, which a fragment draws to at once. The opacity is the fourth channel of
// each.
fn translucent_casters_six_moments(z: f32, opacity: f32, stored_as: u32) -> array<vec4f, 2> {
    let odd = six_moments_to_texel(six_moments_channels(z, 0u), 0u, stored_as);
    let even = six_moments_to_texel(six_moments_channels(z, 1u), 1u, stored_as);
    return array<vec4f, 2>(vec4f(odd.xyz, opacity), vec4f(even.xyz, opacity));
}
