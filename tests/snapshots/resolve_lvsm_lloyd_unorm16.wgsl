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
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const LAYERS = 4u;
const LAYER_OVERLAP = f32(0.0);
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

// moment_shadows/moments/two_moments.wgsl

// Two moments of depth: encoding, storage, smallest variance.
//
// A texel holds the mean b1 of depth and its mean square b2. Channels come in pairs (b1, b2): variance shadow mapping uses xy alone;
// a technique that stores two pairs encodes both at once.

// The smallest variance per storage: what rounding in a resolve and a two-pass blur can take away from b2 - b1^2. With e
// the error of a channel per rounding it is at most 3 (error of b2 + 2 |b1| error of b1):
//   unorm16: e = 2^-17, b1 = 2 r - 1 and b2 = 1 - g:   3 (e + 4 e) = 1.2e-4
//   float16: e = 2^-13 for channels within one half:   3 (e + 4 e) = 1.9e-3
//   float32: e = 2^-25 for values up to 1:             3 (e + 2 e) = 2.7e-7, and the sums of both passes are in float32
// That is with all errors on one side. Half of it covers 99.999 % of adversarial kernels in unorm16 and float16; the sums
// of float32 need a bit more than theirs. A floor as large as the error leaves no variance wrong by more than a factor of 2.
const TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16: f32 = 6e-5;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16: f32 = 1e-3;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32: f32 = 5e-7;

// What is averaged for a depth z in [-1, 1]: its powers.
fn two_moments_from_depth(z: f32) -> vec4f {
    return vec4f(z, z * z, 0.0, 0.0);
}

// What to write for averaged channels. In unorm16 the optimised basis of two moments (r, g) = (u1, 4 u1 - 4 u2), with u the
// moments of (z + 1) / 2 (i3D 2015, section 3.2), which fills the unit square and in terms of z is simply
// ((b1 + 1) / 2, 1 - b2). In float16 the same less one half, around which half precision is finest. In float32 b itself.
fn two_moments_to_texel(channels: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return channels;
    }
    let optimised = saturate(fma(vec4f(0.5, -1.0, 0.5, -1.0), channels, vec4f(0.5, 1.0, 0.5, 1.0)));
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(optimised - 0.5);
    }
    return optimised;
}

// The moments in a (filtered) texel, both pairs, in their ranges whatever the texel holds.
fn two_moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    let finite = storage_finite_texel(texel, storage);
    var channels = finite;
    if storage != STORAGE_FLOAT32 {
        let offset = select(vec4f(-1.0, 1.0, -1.0, 1.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
        channels = fma(vec4f(2.0, -1.0, 2.0, -1.0), finite, offset);
    }
    return clamp(channels, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// The smallest variance of a storage.
fn two_moments_smallest_variance_of(storage: u32) -> f32 {
    if storage == STORAGE_FLOAT32 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16;
    }
    return TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16;
}

// moment_shadows/bounds/chebyshev.wgsl

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

// sup S(z <= fragment_depth) likewise; 1 exactly for fragments that are not in front of the mean.
fn chebyshev_upper_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    return 1.0 - chebyshev_lower_bound(vec2f(-moments.x, moments.y), -fragment_depth, smallest_variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound.
fn chebyshev_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, storage: u32) -> f32 {
    let moments = two_moments_from_texel(texel, storage).xy;
    return chebyshev_lower_bound(moments, depth_of_fragment(fragment_depth), two_moments_smallest_variance_of(storage));
}

// moment_shadows/techniques/layered_variance.wgsl

// Layered variance shadow mapping: variance shadow mapping of several ranges of depth.
//
// Layer [p, q] warps depth by t -> clamp((t - p) / (q - p), 0, 1) before its two moments are taken, so that occluders in
// front of it all coincide: light bleeds only between occluders within the layer that contains the fragment (Lauritzen &
// McCool, "Layered Variance Shadow Maps", GI 2008, section 4; Lauritzen, thesis 2008, section 4.1). The warp here goes to
// [-1, 1] instead of [0, 1], so that encoding, smallest variance and bound are those of `variance`; one layer is the same
// technique, to the bit. A texel holds two layers, so n of them take (n + 1) / 2 planes.

// Up to this many layers.
const LAYERED_VARIANCE_LARGEST_COUNT: u32 = 8u;

// No layer is narrower.
const LAYERED_VARIANCE_SMALLEST_HALF_WIDTH: f32 = 1e-4;

// The layers, front to back.
struct LayeredVarianceLayers {
    // The splits behind layers 0 to count - 2, ascending in [-1, 1]; four to a vector. What follows them is not read.
    splits: array<vec4f, 2>,
    // From 1 to 8.
    count: u32,
    // Both layers at a split reach this far beyond it, and fragments that close to it blend both.
    overlap: f32,
    padding: vec2f,
}

// Where to look a fragment up.
struct LayeredVarianceChoice {
    // The layer that contains the fragment.
    layer: u32,
    // The layer at the other side of the nearest split, and its share in [0, 0.5]; where that is 0 it need not be read.
    neighbor: u32,
    neighbor_share: f32,
}

// The split behind a layer.
fn layered_variance_split(layers: LayeredVarianceLayers, layer: u32) -> f32 {
    var splits = layers.splits;
    let index = min(layer, LAYERED_VARIANCE_LARGEST_COUNT - 1u);
    return clamp(splits[index / 4u][index % 4u], -1.0, 1.0);
}

// The number of layers, from 1 to 8.
fn layered_variance_count(layers: LayeredVarianceLayers) -> u32 {
    return clamp(layers.count, 1u, LAYERED_VARIANCE_LARGEST_COUNT);
}

// The interval [p, q] of a layer with its overlaps; the first begins at -1, the last ends at 1. Indices beyond the last
// count as the last, which fills the second half of the last texel of an odd number of layers.
fn layered_variance_interval(layers: LayeredVarianceLayers, layer: u32) -> vec2f {
    let last = layered_variance_count(layers) - 1u;
    let index = min(layer, last);
    var interval = vec2f(-1.0, 1.0);
    if index > 0u {
        interval.x = max(layered_variance_split(layers, index - 1u) - layers.overlap, -1.0);
    }
    if index < last {
        interval.y = min(layered_variance_split(layers, index) + layers.overlap, 1.0);
    }
    return interval;
}

// Depth as a layer sees it: -1 at its front and before, 1 at its back and beyond. The identity for [-1, 1].
fn layered_variance_warp(z: f32, interval: vec2f) -> f32 {
    let half_width = max(0.5 * (interval.y - interval.x), LAYERED_VARIANCE_SMALLEST_HALF_WIDTH);
    return clamp((z - 0.5 * (interval.x + interval.y)) / half_width, -1.0, 1.0);
}

// What is averaged for a depth z in [-1, 1] in a plane, which holds the layers 2 * plane and 2 * plane + 1; to be written
// with `two_moments_to_texel`.
fn layered_variance_channels(z: f32, layers: LayeredVarianceLayers, plane: u32) -> vec4f {
    let near = layered_variance_warp(z, layered_variance_interval(layers, 2u * plane));
    let far = layered_variance_warp(z, layered_variance_interval(layers, 2u * plane + 1u));
    return vec4f(near, near * near, far, far * far);
}

// The layer of a fragment and how it blends with a neighbor: linearly over the overlap, half of each at the split.
fn layered_variance_choice(layers: LayeredVarianceLayers, fragment_depth: f32) -> LayeredVarianceChoice {
    let depth = depth_of_fragment(fragment_depth);
    let last = layered_variance_count(layers) - 1u;
    var layer = 0u;
    while layer < last && layered_variance_split(layers, layer) < depth {
        layer++;
    }
    let overlap = max(layers.overlap, 1e-30);
    var choice = LayeredVarianceChoice(layer, layer, 0.0);
    if layer > 0u {
        let share = 0.5 - 0.5 * min((depth - layered_variance_split(layers, layer - 1u)) / overlap, 1.0);
        choice = LayeredVarianceChoice(layer, layer - 1u, share);
    }
    if layer < last {
        let share = 0.5 - 0.5 * min((layered_variance_split(layers, layer) - depth) / overlap, 1.0);
        if share > choice.neighbor_share {
            choice = LayeredVarianceChoice(layer, layer + 1u, share);
        }
    }
    return choice;
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment by one layer, for the filtered texel of the plane `layer / 2`: a
// lower bound. Fragments out of the layer count as its ends.
fn layered_variance_shadow_intensity_of_texel(
    texel: vec4f,
    fragment_depth: f32,
    storage: u32,
    layers: LayeredVarianceLayers,
    layer: u32,
) -> f32 {
    let pairs = two_moments_from_texel(texel, storage);
    let moments = select(pairs.xy, pairs.zw, layer % 2u == 1u);
    let warped = layered_variance_warp(depth_of_fragment(fragment_depth), layered_variance_interval(layers, layer));
    return chebyshev_lower_bound(moments, warped, two_moments_smallest_variance_of(storage));
}

// technique_layers

// Layers that are placed on the device, of the one layer of the map that a pass is recorded for.

@group(GROUP) @binding(5) var splits_map: texture_2d<f32>;

fn technique_layers(map_layer: u32) -> LayeredVarianceLayers {
    let low = textureLoad(splits_map, vec2u(0u, 0u), 0);
    let high = textureLoad(splits_map, vec2u(1u, 0u), 0);
    return LayeredVarianceLayers(array<vec4f, 2>(low, high), LAYERS, LAYER_OVERLAP, vec2f(0.0));
}

// map_encoding

// Two moments of each of two layers: what is averaged for a moment depth, and the texel for the mean.

// The plane that is made.
override PLANE: u32;

fn encoding_channels(z: f32) -> vec4f {
    return layered_variance_channels(z, technique_layers(0u), PLANE);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return two_moments_to_texel(mean, STORAGE);
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
