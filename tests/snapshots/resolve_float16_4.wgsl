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
alias MomentsStorage = texture_storage_2d<rgba16float, write>;
const STORAGE = 1u;
const REGIONS = 1u;

// region_tile

// Which part of which region a workgroup makes. Regions change per frame; the number of workgroups does not, and suffices
// for all of them.

@group(GROUP) @binding(4) var<uniform> regions: array<MapRegion, REGIONS>;

struct RegionTile {
    // The region's number in its table.
    number: u32,
    // The region in texels of a mip level; empty where nothing is left to do.
    region: MapRegion,
    // The tile's first texel, from the region's origin on.
    first: vec2u,
}

// The tile of a workgroup that covers `texels` of mip level `level`, in a layer of `size` texels on mip level 0.
fn region_tile(workgroup: vec3u, workgroups: vec3u, size: vec2u, level: u32, texels: vec2u) -> RegionTile {
    if REGIONS == 1u {
        let only = map_region_at_level(map_region_within(regions[0], size), level);
        return RegionTile(0u, only, workgroup.xy * texels);
    }
    // Workgroups are numbered through the regions.
    var index = workgroup.y * workgroups.x + workgroup.x;
    for (var number = 0u; number < REGIONS; number++) {
        let region = map_region_at_level(map_region_within(regions[number], size), level);
        let tiles = (region.extent + texels - 1u) / texels;
        let count = tiles.x * tiles.y;
        if index < count {
            return RegionTile(number, region, vec2u(index % tiles.x, index / tiles.x) * texels);
        }
        index -= count;
    }
    return RegionTile(0u, MapRegion(vec2u(0u), vec2u(0u)), vec2u(0u));
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

// moment_shadows/moments/four_moments.wgsl

// Four moments of depth: encoding, storage, bias.
//
// A texel holds b = (E[z], E[z^2], E[z^3], E[z^4]) of the moment depths z in [-1, 1] that it covers (Peters & Klein,
// "Moment Shadow Mapping", i3D 2015, section 2). Linear filters keep moments valid as long as their weights are not
// negative and sum to one. Storage with few bits holds an affine image of the moments that spreads them over the range
// of every channel (Peters, GDC 2016; JCGT 6(1) 2017, section 3); affine maps commute with filtering.

// A moment bias: b is moved by alpha towards (0, second, 0, fourth), which pulls moments that rounding has made
// impossible back among the possible ones. With one number beta for both these are the moments of occluders at the near
// end, the middle and the far end with the weights beta/2, 1 - beta and beta/2.
struct FourMomentsBias {
    alpha: f32,
    second: f32,
    fourth: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions (found by search: `moment-shadows bias`). Sums of many texels
// in f32 are off by more than the bias of float32 covers, unless they are made as in `split_sum`. The target is optimal for the basis and for distributions on the real line (JCGT 6(1) 2017, section 3).
const FOUR_MOMENTS_BIAS_UNORM16: FourMomentsBias = FourMomentsBias(6e-5, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT16: FourMomentsBias = FourMomentsBias(1e-3, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT32: FourMomentsBias = FourMomentsBias(1.5e-6, 0.375, 0.375);

// sqrt(3), which the optimised basis and its inverse are made of.
const FOUR_MOMENTS_SQRT_3: f32 = 1.7320508075688772;

// The moments of a single depth z in [-1, 1]: its powers (i3D 2015, equation 2).
fn four_moments_from_depth(z: f32) -> vec4f {
    let square = z * z;
    return vec4f(z, square, z * square, square * square);
}

// The optimised basis of JCGT 6(1) 2017 (equation 5, GDC 2016): maps the moments of depths in [-1, 1] into [0, 1]^4.
fn four_moments_quantize(b: vec4f) -> vec4f {
    return vec4f(
        fma(1.5, b.x, fma(-2.0, b.z, 0.5)),
        4.0 * (b.y - b.w),
        fma(0.5 * FOUR_MOMENTS_SQRT_3, b.x, fma(-2.0 / 9.0 * FOUR_MOMENTS_SQRT_3, b.z, 0.5)),
        0.5 * (b.y + b.w),
    );
}

// Inverse of `four_moments_quantize`. Channels in [0, 1] give |b| <= 2.1, whatever they hold.
fn four_moments_dequantize(channels: vec4f) -> vec4f {
    let odd = channels.xz - 0.5;
    return vec4f(
        fma(-1.0 / 3.0, odd.x, FOUR_MOMENTS_SQRT_3 * odd.y),
        fma(0.125, channels.y, channels.w),
        0.75 * fma(FOUR_MOMENTS_SQRT_3, odd.y, -odd.x),
        fma(-0.125, channels.y, channels.w),
    );
}

// Moments that certainly lie in their ranges: odd ones in [-1, 1], even ones in [0, 1]. Float storage can hold
// anything, and finite values beyond 1e15 would overflow further on.
fn four_moments_clamp(b: vec4f) -> vec4f {
    return clamp(b, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// What to write to a texel of the storage.
fn four_moments_to_texel(b: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return b;
    }
    let channels = saturate(four_moments_quantize(b));
    if storage == STORAGE_FLOAT16 {
        // Half precision is finest around zero, so the channels are centred there.
        return storage_round_to_float16(channels - 0.5);
    }
    return channels;
}

// The moments in a (filtered) texel of the storage. Float storage can hold anything; `four_moments_clamp` comes before any
// arithmetic that relies on ranges.
fn four_moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return texel;
    }
    if storage == STORAGE_FLOAT16 {
        return four_moments_dequantize(texel + 0.5);
    }
    return four_moments_dequantize(texel);
}

// The moment bias of a storage.
fn four_moments_bias_of(storage: u32) -> FourMomentsBias {
    if storage == STORAGE_FLOAT32 {
        return FOUR_MOMENTS_BIAS_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return FOUR_MOMENTS_BIAS_FLOAT16;
    }
    return FOUR_MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn four_moments_apply_bias(b: vec4f, bias: FourMomentsBias) -> vec4f {
    return fma(vec4f(bias.alpha), vec4f(0.0, bias.second, 0.0, bias.fourth) - b, b);
}

// The biased moments in a (filtered) texel of the storage, within [-2.1, 2.1]: for unorm storage if the channels are in
// [0, 1], as no texture can help, and for float storage whatever finite numbers it holds.
fn four_moments_biased_from_texel(texel: vec4f, storage: u32, bias: FourMomentsBias) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return four_moments_apply_bias(four_moments_clamp(texel), bias);
    }
    // The inverse of the basis and the bias are both affine, and so one step. These biases are large enough for 1 - alpha.
    let keep = 1.0 - bias.alpha;
    let of_xy = keep * vec4f(-1.0 / 3.0, 0.125, -0.75, -0.125);
    let of_zw = keep * vec4f(FOUR_MOMENTS_SQRT_3, 1.0, 0.75 * FOUR_MOMENTS_SQRT_3, 1.0);
    // Odd moments are 0 for channels of one half, and float16 storage holds one half less.
    let middle = select(vec4f(-0.5, 0.0, -0.5, 0.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
    let shift = fma(middle, of_xy + of_zw, bias.alpha * vec4f(0.0, bias.second, 0.0, bias.fourth));
    let biased = fma(of_xy, texel.xyxy, fma(of_zw, texel.zwzw, shift));
    if storage == STORAGE_FLOAT16 {
        return four_moments_clamp(biased);
    }
    return biased;
}

// map_encoding

// Four moments: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return four_moments_from_depth(z);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
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

// resolve.wgsl

// Resolves the regions of one layer of a depth map to one plane of a filterable map: one texel per invocation.

@group(GROUP) @binding(2) var moments_map: MomentsStorage;

@compute @workgroup_size(8, 8)
fn resolve(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup, workgroups, textureDimensions(moments_map), 0u, vec2u(8u));
    let place = tile.first + local.xy;
    if any(place >= tile.region.extent) {
        return;
    }
    let texel = vec2i(tile.region.origin + place);
    textureStore(moments_map, texel, resolve_texel(texel, tile.number));
}
