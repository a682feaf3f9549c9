// fullscreen
// The vertex stage of fullscreen passes.

struct Covered {
    @builtin(position) position: vec4f,
    // The place in the picture from 0 to 1. Other than `position` it does not depend on where in its target a host has the
    // viewport.
    @location(0) uv: vec2f,
}

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> Covered {
    // One triangle that covers the viewport: (-1, -1), (3, -1), (-1, 3).
    let corner = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    return Covered(vec4f(corner, 0.0, 1.0), 0.5 + vec2f(0.5, -0.5) * corner);
}

// moment_shadows/map/map_region.wgsl
// Regions: rectangles of a layer that share an atlas and know nothing of each other.
//
// Mip level k of a region runs from floor(first / 2^k) to floor(end / 2^k). Regions that touch share that edge on every
// level, wherever it lies, so none covers a texel of another, and a gutter is not needed.

// Filled by the host-side `MapRegion`: texels of mip level 0. No texels: no region. A rectangle that leaves the map is
// cut off at its border.
struct MapRegion {
    origin: vec2u,
    extent: vec2u,
}

// The part of a region that lies in a map of `size` texels.
fn map_region_within(region: MapRegion, size: vec2u) -> MapRegion {
    let origin = min(region.origin, size);
    return MapRegion(origin, min(region.extent, size - origin));
}

// A region of a map (within it) on mip level `level`, below 32.
fn map_region_at_level(region: MapRegion, level: u32) -> MapRegion {
    let origin = region.origin >> vec2u(level);
    return MapRegion(origin, ((region.origin + region.extent) >> vec2u(level)) - origin);
}

// The coarsest of `levels` mip levels on which a region still has texels.
fn map_region_last_level(region: MapRegion, levels: u32) -> u32 {
    var level = max(levels, 1u) - 1u;
    while level > 0u && any(map_region_at_level(region, level).extent == vec2u(0u)) {
        level--;
    }
    return level;
}

// The place of `uv` (from 0 to 1 across the region) in texels of a region's mip level, kept half a texel away from its
// edge: a bilinear filter there reads no other region.
fn map_region_place(region_on_level: MapRegion, uv: vec2f) -> vec2f {
    let extent = vec2f(region_on_level.extent);
    return vec2f(region_on_level.origin) + clamp(uv * extent, vec2f(0.5), max(extent - 0.5, vec2f(0.5)));
}

// specialization
const GROUP = 0;
alias DepthTexture = texture_depth_multisampled_2d;
const SAMPLES = 4;
const STORAGE = 5u;
const REGIONS = 1u;

// region_pixel

// Which region a pixel of a drawn map lies in. Regions change per frame; what is drawn, the whole layer, does not.

@group(GROUP) @binding(4) var<uniform> regions: array<MapRegion, REGIONS>;

struct RegionPixel {
    // The number of its region in the table; REGIONS where it lies in none.
    number: u32,
    // That region in texels of the mip level.
    region: MapRegion,
    // The pixel, a texel of the mip level.
    texel: vec2u,
}

// The pixel at `uv` (from 0 to 1 across the target) of mip level `level`, in a layer of `size` texels on mip level 0.
fn region_pixel(uv: vec2f, size: vec2u, level: u32) -> RegionPixel {
    let drawn = max(size >> vec2u(level), vec2u(1u));
    let texel = min(vec2u(uv * vec2f(drawn)), drawn - 1u);
    for (var number = 0u; number < REGIONS; number++) {
        let region = map_region_at_level(map_region_within(regions[number], size), level);
        // Of unsigned numbers those below the origin wrap around to large ones.
        if all(texel - region.origin < region.extent) {
            return RegionPixel(number, region, texel);
        }
    }
    return RegionPixel(REGIONS, MapRegion(vec2u(0u), vec2u(0u)), texel);
}

// moment_shadows/map/depth.wgsl
// Moment depth: the one interval that all moment arithmetic uses.
//
// Moment depth z is in [-1, 1], -1 at the light's near end and 1 at its far end, linear in distance along the light's
// axis. Signed depth needs a far smaller moment bias than depth in [0, 1] (Peters et al., JCGT 6(1) 2017, section 3).
// Every way in which a host stores depth (forward or reversed, orthographic or perspective, finite or infinite far
// plane, linear distance) is a ratio of two functions that are linear in the stored value, so one conversion serves all.

// How stored depth becomes moment depth. Filled by the host-side `DepthConversion`.
//
// With d = clamp(scale * stored + offset, 0, 1) the moment depth is
//   ((1 - d) * numerator.x + d * numerator.y) / ((1 - d) * denominator.x + d * denominator.y).
// Weighting the ends by 1 - d and d keeps both sums free of cancellation: a light with a near/far ratio of 1e5 in
// reversed float depth keeps its precision. The denominators are not negative, and not both zero.
struct DepthConversion {
    numerator: vec2f,
    denominator: vec2f,
    scale: f32,
    offset: f32,
    // Keeps the size a multiple of 16, as uniform buffers ask for arrays of it.
    padding: vec2f,
}

// The smallest denominator: the far end of an infinite projection divides by zero.
const DEPTH_SMALLEST_DENOMINATOR: f32 = 1e-30;

// The moment depth of a light with parallel rays.
const DEPTH_INFINITELY_FAR: f32 = -1e30;

// Whether `value` is NaN, by its bits: WGSL lets a compiler assume that no NaN occurs, so `value != value` may be folded.
fn depth_is_nan(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7fffffffu) > 0x7f800000u;
}

// Moment depth in [-1, 1] of a stored depth. NaN counts as the far end (no caster), infinities and values out of
// range as the nearer end of the interval.
fn depth_to_moment_depth(stored: f32, conversion: DepthConversion) -> f32 {
    let d = clamp(fma(clamp(stored, -3e38, 3e38), conversion.scale, conversion.offset), 0.0, 1.0);
    let ends = vec2f(1.0 - d, d);
    let ratio = dot(ends, conversion.numerator) / max(dot(ends, conversion.denominator), DEPTH_SMALLEST_DENOMINATOR);
    return select(clamp(ratio, -1.0, 1.0), 1.0, depth_is_nan(stored));
}

// The depth of a fragment in [-1, 1]: beyond the light's range it counts as the nearer end, and NaN as the near end, where
// every lower bound is 0.
fn depth_of_fragment(fragment_depth: f32) -> f32 {
    return select(clamp(fragment_depth, -1.0, 1.0), -1.0, depth_is_nan(fragment_depth));
}

// The stored depth of a moment depth: the inverse of the above, as the reference value of a comparison sampler. Moment
// depths that the stored interval does not reach count as its nearer end, NaN as the far end.
fn depth_from_moment_depth(moment_depth: f32, conversion: DepthConversion) -> f32 {
    let z = select(clamp(moment_depth, -1.0, 1.0), 1.0, depth_is_nan(moment_depth));
    let numerator = conversion.numerator;
    let denominator = conversion.denominator;
    // The weights d and 1 - d of the two ends, up to a factor that is positive where depth is stored from near to far.
    let weights = vec2f(fma(z, denominator.x, -numerator.x), fma(-z, denominator.y, numerator.y));
    let reversed = numerator.y * denominator.x < numerator.x * denominator.y;
    let positive = max(select(weights, -weights, reversed), vec2f(0.0));
    let d = positive.x / max(positive.x + positive.y, DEPTH_SMALLEST_DENOMINATOR);
    let scale = select(max(conversion.scale, DEPTH_SMALLEST_DENOMINATOR), min(conversion.scale, -DEPTH_SMALLEST_DENOMINATOR), conversion.scale < 0.0);
    return clamp((d - conversion.offset) / scale, -3e38, 3e38);
}

// The moment depth of a light's own place, below -1; DEPTH_INFINITELY_FAR where the stored depth is linear, as parallel rays
// have it.
fn depth_of_light(conversion: DepthConversion) -> f32 {
    // A perspective conversion tends to it where d grows without bounds.
    let divisor = conversion.denominator.y - conversion.denominator.x;
    if abs(divisor) < DEPTH_SMALLEST_DENOMINATOR {
        return DEPTH_INFINITELY_FAR;
    }
    return clamp((conversion.numerator.y - conversion.numerator.x) / divisor, DEPTH_INFINITELY_FAR, -1.0);
}

// moment_shadows/map/storage.wgsl
// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that its bound has to
// cover. Nothing here depends on a technique: how one spreads its quantities over the range of a storage is its own.

// Storages, as a shader's specialisation names them.
const STORAGE_UNORM16: u32 = 0u;
const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;
const STORAGE_UNORM8: u32 = 3u;
// Sums of channels as unorm16 has them; see `summed_area_encoding`.
const STORAGE_FIXED32: u32 = 4u;
// Three channels to a texel, in maps that are drawn.
const STORAGE_UNORM10: u32 = 5u;

// The largest finite float16.
const STORAGE_LARGEST_FLOAT16: f32 = 65504.0;

// Whether the channels of the storage are floats, which can be anything, rather than numbers in [0, 1].
fn storage_is_float(storage: u32) -> bool {
    return storage == STORAGE_FLOAT16 || storage == STORAGE_FLOAT32;
}

// The nearest float16 of each component, ties to even, for |value| <= 65504. A driver may truncate when it stores to a
// float16 texture, which would double the rounding error that a bound has to cover.
fn storage_round_to_float16(value: vec4f) -> vec4f {
    let bits = bitcast<vec4u>(value);
    // 13 of 23 mantissa bits go; adding just under half a unit, plus the last kept bit, rounds ties to even.
    let rounded = bitcast<vec4f>((bits + 0xfffu + ((bits >> vec4u(13u)) & vec4u(1u))) & vec4u(0xffffe000u));
    // Below 2^-14 float16 is a fixed-point format with a step of 2^-24.
    let small = round(value * 16777216.0) * 5.960464477539063e-8;
    return select(rounded, small, abs(value) < vec4f(6.103515625e-5));
}

// What to draw so that a target of 10 bits per channel holds the nearest number to each component, for any finite value. A driver
// may round down, or round to 16 bits and drop the last six (lavapipe does): a little above that number they give it all the same.
fn storage_round_to_unorm10(value: vec4f) -> vec4f {
    return (round(saturate(value) * 1023.0) + 0.00390625) / 1023.0;
}

// A filtered combination of texels, as it has to be written back to the same storage.
fn storage_round_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    if storage == STORAGE_UNORM10 {
        return storage_round_to_unorm10(texel);
    }
    return texel;
}

// A texel in which channels that are NaN or infinite count as 0, found by their bits since a compiler may assume that
// there is neither. Unorm texels pass as they are.
fn storage_finite_texel(texel: vec4f, storage: u32) -> vec4f {
    if !storage_is_float(storage) {
        return texel;
    }
    let exponent = bitcast<vec4u>(texel) & vec4u(0x7f800000u);
    return select(texel, vec4f(0.0), exponent == vec4u(0x7f800000u));
}

// moment_shadows/moments/six_moments.wgsl

// Six moments of depth: encoding, storage, bias.
//
// A map holds b = (E[z], ..., E[z^6]) of the moment depths z in [-1, 1] that a texel covers, in two texels: the odd moments
// in one, the even ones in the other, since the optimised basis mixes neither with the other (Peters, GDC 2016; Peters et
// al., JCGT 6(1) 2017). Like that of four moments it spreads the moments over the range of every channel, and commutes
// with filtering.

// The moments of one distribution.
struct SixMoments {
    // E[z], E[z^3], E[z^5].
    odd: vec3f,
    // E[z^2], E[z^4], E[z^6].
    even: vec3f,
}

// A moment bias: b is moved by alpha towards moments whose odd ones are 0.
struct SixMomentsBias {
    // The target's E[z^2], E[z^4], E[z^6].
    even: vec3f,
    alpha: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions. 3e-6 would do so for float32, but below 8e-6 what is left of
// the last pivot of `hamburger6` in f32 can be nothing but rounding. 5e-3 would do so for unorm10, but a search for the worst regions
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

// Their inverses, by columns.
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

// What is subtracted from channels before they are stored: floats are finest around zero.
fn six_moments_middle(storage: u32) -> f32 {
    return select(0.0, 0.5, storage_is_float(storage));
}

// A texel of three channels, with 1 in the fourth.
fn six_moments_texel(channels: vec3f, storage: u32) -> vec4f {
    return storage_round_texel(vec4f(saturate(channels) - six_moments_middle(storage), 1.0), storage);
}

// What to write to the first texel of the storage: the odd moments.
fn six_moments_to_odd_texel(odd: vec3f, storage: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_ODD_BASIS, odd, SIX_MOMENTS_ODD_OFFSET), storage);
}

// What to write to the second one: the even moments.
fn six_moments_to_even_texel(even: vec3f, storage: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_EVEN_BASIS, even, SIX_MOMENTS_EVEN_OFFSET), storage);
}

// What is averaged for a moment depth z in [-1, 1], for one of the two texels: three odd moments for plane 0, three even ones for
// plane 1.
fn six_moments_channels(z: f32, plane: u32) -> vec4f {
    let moments = six_moments_from_depth(z);
    return vec4f(select(moments.even, moments.odd, plane == 0u), 1.0);
}

// What to write to a texel of the storage for averaged channels of a plane.
fn six_moments_to_texel(mean: vec4f, plane: u32, storage: u32) -> vec4f {
    if plane == 0u {
        return six_moments_to_odd_texel(mean.xyz, storage);
    }
    return six_moments_to_even_texel(mean.xyz, storage);
}

// Both texels.
fn six_moments_to_texels(b: SixMoments, storage: u32) -> array<vec4f, 2> {
    return array<vec4f, 2>(six_moments_to_odd_texel(b.odd, storage), six_moments_to_even_texel(b.even, storage));
}

// The moments in the two (filtered) texels of the storage, |b| < 1.05. Float storage can hold anything: channels beyond their
// range count as its ends. Channels and not moments are clamped, since the bias covers errors of channels; moments at the ends
// of their ranges, of which rounding has moved one inwards, would need one ten times as large if the others were clamped.
fn six_moments_from_texels(texels: array<vec4f, 2>, storage: u32) -> SixMoments {
    let middle = six_moments_middle(storage);
    var odd = texels[0].xyz;
    var even = texels[1].xyz;
    if storage_is_float(storage) {
        odd = clamp(odd, vec3f(-0.5), vec3f(0.5));
        even = clamp(even, vec3f(-0.5), vec3f(0.5));
    }
    return SixMoments(
        six_moments_affine(SIX_MOMENTS_ODD_INVERSE, odd - (SIX_MOMENTS_ODD_OFFSET - middle), vec3f(0.0)),
        six_moments_affine(SIX_MOMENTS_EVEN_INVERSE, even - (SIX_MOMENTS_EVEN_OFFSET - middle), vec3f(0.0)),
    );
}

// The moment bias of a storage.
fn six_moments_bias_of(storage: u32) -> SixMomentsBias {
    if storage == STORAGE_FLOAT32 {
        return SIX_MOMENTS_BIAS_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return SIX_MOMENTS_BIAS_FLOAT16;
    }
    if storage == STORAGE_UNORM10 {
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

// map_encoding

// Three of six moments: what is averaged for a moment depth, and the texel for the mean.

// The plane that is made: 0 for odd moments, 1 for even ones.
override PLANE: u32;

fn encoding_channels(z: f32) -> vec4f {
    let moments = six_moments_from_depth(z);
    return vec4f(select(moments.even, moments.odd, PLANE == 0u), 1.0);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    if PLANE == 0u {
        return six_moments_to_odd_texel(mean.xyz, STORAGE);
    }
    return six_moments_to_even_texel(mean.xyz, STORAGE);
}

// resolve_texel

// What a texel of one plane of a filterable map holds, from one layer of a depth map.
//
// The moments (or other channels) of the samples are averaged. Averaging depths instead would put an occluder between foreground and
// background, where there is none (Peters & Klein, i3D 2015, section 4).

@group(GROUP) @binding(0) var<uniform> conversions: array<DepthConversion, REGIONS>;
@group(GROUP) @binding(1) var depth_map: DepthTexture;

// The texel of the map, in the region of this number.
fn resolve_texel(texel: vec2i, region: u32) -> vec4f {
    let conversion = conversions[region];
    var sum = vec4f(0.0);
    // For a single sample the last argument of the load is its mip level, 0.
    for (var sample = 0; sample < SAMPLES; sample++) {
        let stored = textureLoad(depth_map, texel, sample);
        sum += encoding_channels(depth_to_moment_depth(stored, conversion));
    }
    return encoding_texel(sum / f32(SAMPLES));
}

// resolve_drawn.wgsl

// Resolves one layer of a depth map to one plane of a filterable map that is drawn: one texel per pixel.

@fragment
fn resolve(covered: Covered) -> @location(0) vec4f {
    let pixel = region_pixel(covered.uv, textureDimensions(depth_map), 0u);
    // What lies in no region is not this pass's.
    if pixel.number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    return resolve_texel(vec2i(pixel.texel), pixel.number);
}
