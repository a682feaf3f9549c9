import node::fullscreen::{Covered};
import moment_shadows::moments::four_moments::{FourMomentsBias, four_moments_apply_bias, four_moments_bias_of, four_moments_bias_rounded_inwards_of, four_moments_from_texel};
import node::specialization::{GROUP, ROUNDED_INWARDS, SHOW, STORAGE};

// A map of moments as a picture, for the day on which a shadow is black or missing.

@group(GROUP) @binding(0) var moments_level: texture_2d<f32>;

// What is shown.
const SHOW_MOMENTS = 0u;
const SHOW_MEAN = 1u;
const SHOW_DEVIATION = 2u;

// The colours of validity.
const NOT_FINITE = vec4f(1.0, 0.0, 1.0, 1.0);
const EMPTY = vec4f(0.1, 0.1, 0.4, 1.0);
const IMPOSSIBLE = vec4f(1.0, 0.0, 0.0, 1.0);
const REPAIRED = vec4f(0.9, 0.8, 0.1, 1.0);
const POSSIBLE = vec4f(0.1, 0.6, 0.2, 1.0);

// Whether any component is infinite or NaN, by its bits.
fn is_not_finite(texel: vec4f) -> bool {
    return any((bitcast<vec4u>(texel) & vec4u(0x7f800000u)) == vec4u(0x7f800000u));
}

// The smaller of the two conditions for moments that some distribution has, both times the variance: the variance itself,
// and the determinant of the Hankel matrix (Peters & Klein, i3D 2015, section 2.2). Not negative where there is one.
fn possible(b: vec4f) -> bool {
    let variance = b.y - b.x * b.x;
    let covariance = b.z - b.x * b.y;
    return variance >= 0.0 && variance * (b.w - b.y * b.y) >= covariance * covariance;
}

fn moment_bias() -> FourMomentsBias {
    if ROUNDED_INWARDS {
        return four_moments_bias_rounded_inwards_of(STORAGE);
    }
    return four_moments_bias_of(STORAGE);
}

fn validity(b: vec4f) -> vec4f {
    // The far end alone: nothing was drawn here, or nothing was resolved.
    if all(abs(b - 1.0) < vec4f(2e-3)) {
        return EMPTY;
    }
    if possible(b) {
        return POSSIBLE;
    }
    // Rounding to the storage makes moments of few surfaces impossible; that is what the moment bias is for.
    return select(IMPOSSIBLE, REPAIRED, possible(four_moments_apply_bias(b, moment_bias())));
}

@fragment
fn debug(covered: Covered) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(moments_level));
    let place = clamp(vec2i(covered.uv * vec2f(size)), vec2i(0), size - 1);
    let texel = textureLoad(moments_level, place, 0);
    if is_not_finite(texel) {
        return NOT_FINITE;
    }
    let b = clamp(four_moments_from_texel(texel, STORAGE), vec4f(-4.0), vec4f(4.0));
    if SHOW == SHOW_MOMENTS {
        return vec4f(fma(b.xyz, vec3f(0.5, 1.0, 0.5), vec3f(0.5, 0.0, 0.5)), 1.0);
    }
    if SHOW == SHOW_MEAN {
        return vec4f(vec3f(fma(b.x, 0.5, 0.5)), 1.0);
    }
    if SHOW == SHOW_DEVIATION {
        return vec4f(vec3f(sqrt(max(b.y - b.x * b.x, 0.0))), 1.0);
    }
    return validity(b);
}
