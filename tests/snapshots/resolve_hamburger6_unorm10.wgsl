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


// moment_shadows/map/storage.wgsl
// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that its bound has to
// cover. Nothing here depends on a technique: how one spreads its quantities over the range of a storage is its own.

const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;

// Three channels to a texel, in maps that are drawn.
const STORAGE_UNORM10: u32 = 5u;

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
    let small = round(value * 0x1p24) * 0x1p-24;
    return select(rounded, small, abs(value) < vec4f(0x1p-14));
}

// What to draw so that a target of 10 bits per channel holds the nearest number to each component, for any finite value. A driver
// may round down, or round to 16 bits and drop the last six (lavapipe does): a little above that number they give it all the same.
fn storage_round_to_unorm10(value: vec4f) -> vec4f {
    return (round(saturate(value) * 1023.0) + 0x1p-8) / 1023.0;
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
