import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_UNORM10, storage_is_float, storage_round_texel};

// Six moments of depth: encoding, storage, bias.
//
// A map holds b = (E[z], ..., E[z^6]) of the moment depths z in [-1, 1] that a texel covers, in two texels: the odd moments
// in one, the even ones in the other, since the optimised basis mixes neither with the other (Peters, GDC 2016; Peters et
// al., JCGT 6(1) 2017). Like the basis of four moments, it spreads the moments over the range of every channel and commutes
// with filtering.

// The moments of one distribution.
struct SixMoments {
    // E[z], E[z^3], E[z^5].
    odd: vec3f,
    // E[z^2], E[z^4], E[z^6].
    even: vec3f,
}

// A moment bias: b is moved by alpha towards a target whose odd moments are 0.
struct SixMomentsBias {
    // The target's E[z^2], E[z^4], E[z^6].
    even: vec3f,
    alpha: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions. 3e-6 would suffice for float32, but below 8e-6 the last pivot
// of `hamburger6` in f32 can consist of rounding alone. 5e-3 would suffice for unorm10, but a search for the worst regions
// finds some that need up to 6.5e-3, and with 5.5e-3 the bound exceeds the truth of one of them by 2.7e-2. The target is the
// one published for moment-based transparency (Muenstermann et al., "Moment-Based Order-Independent Transparency", i3D 2018).
const SIX_MOMENTS_BIAS_TARGET: vec3f = vec3f(0.5566, 0.489, 0.47869382);
const SIX_MOMENTS_BIAS_UNORM16: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1e-4);
const SIX_MOMENTS_BIAS_FLOAT16: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1.5e-3);
const SIX_MOMENTS_BIAS_FLOAT32: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1e-5);
const SIX_MOMENTS_BIAS_UNORM10: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 6.5e-3);

// The optimised basis, by columns: these products plus the offsets map the odd and the even moments of depths in [-1, 1]
// into [0, 1]^3 each.
const SIX_MOMENTS_ODD_BASIS: mat3x3f = mat3x3f(
    2.5, -1.8749986445, 1.26583039016,
    -10.0, 4.20757543111, -1.47644882902,
    8.0, -1.83257678661, 0.71061660238,
);
const SIX_MOMENTS_EVEN_BASIS: mat3x3f = mat3x3f(
    4.0, 9.0, -0.57759806484,
    -4.0, -24.0, 4.61936647543,
    0.0, 16.0, -3.07953906655,
);
const SIX_MOMENTS_ODD_OFFSET: vec3f = vec3f(0.5);
const SIX_MOMENTS_EVEN_OFFSET: vec3f = vec3f(0.0, 0.0, 0.018888946);

// The inverses of both bases, by columns.
const SIX_MOMENTS_ODD_INVERSE: mat3x3f = mat3x3f(
    -0.02877789191977914, 0.09995235706024454, 0.25893353755023666,
    0.4763555042123262, 0.8453258093069343, 0.907796166567316,
    1.5524280897137293, 1.0547257075981561, 0.8332733564621547,
);
const SIX_MOMENTS_EVEN_INVERSE: mat3x3f = mat3x3f(
    1.2530436076429571e-5, -0.24998746956392357, -0.37498825271617835,
    0.16668494186053159, 0.16668494186053159, 0.21876713299424836,
    0.866025405794346, 0.866025405794346, 0.8118988179321994,
);

// matrix * vector + offset, every step fused where the hardware does.
fn six_moments_affine(matrix: mat3x3f, vector: vec3f, offset: vec3f) -> vec3f {
    let last = fma(matrix[2], vector.zzz, offset);
    return fma(matrix[0], vector.xxx, fma(matrix[1], vector.yyy, last));
}

// The moments of a single depth z in [-1, 1]: its powers.
fn six_moments_from_depth(z: f32) -> SixMoments {
    let square = z * z;
    let powers = vec3f(1.0, square, square * square);
    return SixMoments(z * powers, square * powers);
}

// The value that is subtracted from channels before they are stored: floats are finest around zero.
fn six_moments_middle(stored_as: u32) -> f32 {
    return select(0.0, 0.5, storage_is_float(stored_as));
}

// A texel of three channels, with 1 in the fourth.
fn six_moments_texel(channels: vec3f, stored_as: u32) -> vec4f {
    return storage_round_texel(vec4f(saturate(channels) - six_moments_middle(stored_as), 1.0), stored_as);
}

// The first texel to write in the storage: the odd moments.
fn six_moments_to_odd_texel(odd: vec3f, stored_as: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_ODD_BASIS, odd, SIX_MOMENTS_ODD_OFFSET), stored_as);
}

// The second texel to write in the storage: the even moments.
fn six_moments_to_even_texel(even: vec3f, stored_as: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_EVEN_BASIS, even, SIX_MOMENTS_EVEN_OFFSET), stored_as);
}

// The channels to average for a moment depth z in [-1, 1], in one of the two texels: three odd moments for plane 0, three
// even ones for plane 1.
fn six_moments_channels(z: f32, plane: u32) -> vec4f {
    let moments = six_moments_from_depth(z);
    return vec4f(select(moments.even, moments.odd, plane == 0u), 1.0);
}

// The texel to write in the storage for averaged channels of a plane.
fn six_moments_to_texel(mean: vec4f, plane: u32, stored_as: u32) -> vec4f {
    if plane == 0u {
        return six_moments_to_odd_texel(mean.xyz, stored_as);
    }
    return six_moments_to_even_texel(mean.xyz, stored_as);
}

// The three channels of a (filtered) texel of the storage. Float storage can hold anything: channels beyond their range count
// as its ends. Channels are clamped rather than moments, since the bias covers errors of channels; moments at the ends of
// their ranges, one of which rounding has moved inwards, would need a bias ten times as large if the others were clamped.
fn six_moments_channels_of(texel: vec4f, stored_as: u32) -> vec3f {
    if storage_is_float(stored_as) {
        return clamp(texel.xyz, vec3f(-0.5), vec3f(0.5));
    }
    return texel.xyz;
}

// The moments of channels in their ranges, from which `middle` was subtracted. |b| < 1.05.
fn six_moments_from_channels(odd: vec3f, even: vec3f, middle: f32) -> SixMoments {
    return SixMoments(
        six_moments_affine(SIX_MOMENTS_ODD_INVERSE, odd - (SIX_MOMENTS_ODD_OFFSET - middle), vec3f(0.0)),
        six_moments_affine(SIX_MOMENTS_EVEN_INVERSE, even - (SIX_MOMENTS_EVEN_OFFSET - middle), vec3f(0.0)),
    );
}

// The moments in the two (filtered) texels of the storage, |b| < 1.05.
fn six_moments_from_texels(texels: array<vec4f, 2>, stored_as: u32) -> SixMoments {
    let odd = six_moments_channels_of(texels[0], stored_as);
    return six_moments_from_channels(odd, six_moments_channels_of(texels[1], stored_as), six_moments_middle(stored_as));
}

// The moment bias of a storage.
fn six_moments_bias_of(stored_as: u32) -> SixMomentsBias {
    if stored_as == STORAGE_FLOAT32 {
        return SIX_MOMENTS_BIAS_FLOAT32;
    }
    if stored_as == STORAGE_FLOAT16 {
        return SIX_MOMENTS_BIAS_FLOAT16;
    }
    if stored_as == STORAGE_UNORM10 {
        return SIX_MOMENTS_BIAS_UNORM10;
    }
    return SIX_MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn six_moments_apply_bias(b: SixMoments, bias: SixMomentsBias) -> SixMoments {
    let alpha = vec3f(bias.alpha);
    return SixMoments(fma(-alpha, b.odd, b.odd), fma(alpha, bias.even - b.even, b.even));
}

// The biased moments of channels in their ranges, from which `middle` was subtracted. |b| < 1.05. The inverse of the basis and
// the bias are both affine, and so one step; the bias is a constant, large enough for 1 - alpha.
fn six_moments_biased_from_channels(odd: vec3f, even: vec3f, middle: f32, bias: SixMomentsBias) -> SixMoments {
    let odd_inverse = (1.0 - bias.alpha) * SIX_MOMENTS_ODD_INVERSE;
    let even_inverse = (1.0 - bias.alpha) * SIX_MOMENTS_EVEN_INVERSE;
    let odd_shift = six_moments_affine(odd_inverse, middle - SIX_MOMENTS_ODD_OFFSET, vec3f(0.0));
    let even_shift = six_moments_affine(even_inverse, middle - SIX_MOMENTS_EVEN_OFFSET, bias.alpha * bias.even);
    return SixMoments(
        six_moments_affine(odd_inverse, odd, odd_shift),
        six_moments_affine(even_inverse, even, even_shift),
    );
}

// The biased moments in the two (filtered) texels of the storage, |b| < 1.05.
fn six_moments_biased_from_texels(texels: array<vec4f, 2>, stored_as: u32) -> SixMoments {
    let bias = six_moments_bias_of(stored_as);
    if stored_as == STORAGE_FLOAT32 {
        return six_moments_apply_bias(six_moments_from_texels(texels, stored_as), bias);
    }
    let odd = six_moments_channels_of(texels[0], stored_as);
    let even = six_moments_channels_of(texels[1], stored_as);
    return six_moments_biased_from_channels(odd, even, six_moments_middle(stored_as), bias);
}
