import super::super::map::depth::{depth_of_fragment};
import super::super::moments::two_moments::{two_moments_from_texel, two_moments_smallest_variance_of};

// Variance shadow mapping: the sharpest bound on shadow intensity that two moments allow.
//
// A texel holds the mean b1 of depth and its mean square b2. The share of depth in front of the fragment is at least
// d^2 / (b2 - b1^2 + d^2) for a fragment at d > 0 behind the mean (Chebyshev's inequality, one-sided; Donnelly &
// Lauritzen, "Variance Shadow Maps", i3D 2006, equation 5). One plane in front of another is reproduced exactly; behind
// two occluders light bleeds (Lauritzen, thesis 2008, section 3.4).

// inf S(z < fragment_depth) over all distributions S with the mean and mean square `moments`; 0 exactly for fragments
// that are not behind the mean. Any unit of depth will do as long as no square exceeds 2^126; `smallest_variance` > 0 is in
// the square of that unit.
fn chebyshev_lower_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    let variance = max(fma(-moments.x, moments.x, moments.y), smallest_variance);
    let distance = max(fragment_depth - moments.x, 0.0);
    let square = distance * distance;
    return square / (variance + square);
}

// sup S(z <= fragment_depth) over all distributions S with the mean and mean square `moments`; 1 exactly for fragments that
// are not in front of the mean. Units are as in `chebyshev_lower_bound`.
fn chebyshev_upper_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    return 1.0 - chebyshev_lower_bound(vec2f(-moments.x, moments.y), -fragment_depth, smallest_variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound.
fn chebyshev_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, stored_as: u32) -> f32 {
    let moments = two_moments_from_texel(texel, stored_as).xy;
    return chebyshev_lower_bound(moments, depth_of_fragment(fragment_depth), two_moments_smallest_variance_of(stored_as));
}
