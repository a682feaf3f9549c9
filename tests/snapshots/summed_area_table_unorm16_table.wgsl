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
alias SumsStorage = texture_storage_2d<rgba32uint, write>;
const STORAGE = 0u;
const UNIT = 65535u;
const TILE = vec2u(8u, 16u);
const WORKGROUP = vec2u(8u, 8u);
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

// sums
// Sums of four channels.

alias Sums = vec4u;

fn sums_of(channels: vec4u) -> Sums {
    return channels;
}

fn sums_texel(sums: Sums) -> vec4u {
    return sums;
}

// sums_target

// What the columns of a tile are written to: one layer.

@group(GROUP) @binding(1) var target_map: SumsStorage;

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

// moment_shadows/filter/summed_area_encoding.wgsl

// The integers that a summed-area table sums up, and how exact the means are that come back.
//
// Channels are those of the storage unorm16: in [0, 1], with the optimised basis. From a unorm16 map they are its own 16-bit
// integers, with the unit 65535 and no rounding beyond the map's. Other maps are rounded to multiples of 1 / unit with
// unit = floor((2^32 - 1) / n) less the bits that f32 would round, n being the texels of the largest kernel: not 2^32 / n,
// since n channels of exactly 1, as every region without a caster has, would then wrap around to 0 (Peters et al.,
// JCGT 6(1) 2017, section 4).

// The most texels of a kernel: n * 65535 < 2^32. Other maps keep to it, too, so that no table is less exact than 16 bits.
const SUMMED_AREA_ENCODING_LARGEST_AREA: u32 = 65537u;

// What the unit of a unorm16 map's table is.
const SUMMED_AREA_ENCODING_UNIT_UNORM16: f32 = 65535.0;

// The moment bias per error of a channel, for Hamburger's target and the optimised basis (found by maximisation over the
// boundary of the moment space: `moment-shadows bias`).
const SUMMED_AREA_ENCODING_BIAS_PER_ERROR: f32 = 4.88;

// What f32 adds to it, in the query, the basis and its inverse; and how much it takes at least, however small the error is
// (found by search: `moment-shadows bias --tables`).
const SUMMED_AREA_ENCODING_BIAS_OF_F32: f32 = 4e-7;
const SUMMED_AREA_ENCODING_SMALLEST_BIAS: f32 = 1e-6;

// The same for the smallest variance of two moments: 5 e for b2 - b1^2 with b1 = 2 r - 1 and b2 = 1 - g.
const SUMMED_AREA_ENCODING_VARIANCE_PER_ERROR: f32 = 5.0;
const SUMMED_AREA_ENCODING_VARIANCE_OF_F32: f32 = 4e-7;
const SUMMED_AREA_ENCODING_SMALLEST_VARIANCE: f32 = 1.2e-6;

// The 16-bit integers of a texel of unorm16.
fn summed_area_encoding_of_unorm16(texel: vec4f) -> vec4u {
    // At 2^23 the last bit of the mantissa is 1: adding that rounds, and leaves the integer in the low bits.
    return bitcast<vec4u>(fma(texel, vec4f(65535.0), vec4f(8388608.0))) & vec4u(0xffffu);
}

// Channels in [0, 1] in units: channel * unit to the nearest integer, up to 2^-31 of the channel and never above `unit`.
// f32 would be 8 bits short of it.
fn summed_area_encoding_of_channels(channels: vec4f, unit: u32) -> vec4u {
    let fraction = vec4u(round(saturate(channels) * 2147483648.0));
    // The upper half of a product of 64 bits, by products of 16.
    let high = fraction >> vec4u(16u);
    let low = fraction & vec4u(0xffffu);
    let unit_high = unit >> 16u;
    let unit_low = unit & 0xffffu;
    let high_low = high * unit_low;
    let low_high = low * unit_high;
    // 0x4000 is one half of a unit: the product is divided by 2^31.
    let middle = ((low * unit_low) >> vec4u(16u)) + (high_low & vec4u(0xffffu)) + (low_high & vec4u(0xffffu)) + 0x4000u;
    let upper = high * unit_high + (high_low >> vec4u(16u)) + (low_high >> vec4u(16u)) + (middle >> vec4u(16u));
    return (upper << vec4u(1u)) | ((middle >> vec4u(15u)) & vec4u(1u));
}

// The moment bias for four moments from a table whose channels are off by up to `error`, on the real line.
fn summed_area_encoding_moment_bias(error: f32) -> FourMomentsBias {
    let alpha = fma(SUMMED_AREA_ENCODING_BIAS_PER_ERROR, error, SUMMED_AREA_ENCODING_BIAS_OF_F32);
    return FourMomentsBias(max(alpha, SUMMED_AREA_ENCODING_SMALLEST_BIAS), 0.628, 0.628);
}

// The smallest variance of two moments from such a table.
fn summed_area_encoding_smallest_variance(error: f32) -> f32 {
    let variance = fma(SUMMED_AREA_ENCODING_VARIANCE_PER_ERROR, error, SUMMED_AREA_ENCODING_VARIANCE_OF_F32);
    return max(variance, SUMMED_AREA_ENCODING_SMALLEST_VARIANCE);
}

// source

// Maps of unorm16: their own integers.

fn source_integers(texel: vec4f) -> vec4u {
    return summed_area_encoding_of_unorm16(texel);
}

// tile_columns

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

struct TileColumns {
    c0: Sums,
    c1: Sums,
    c2: Sums,
    c3: Sums,
    c4: Sums,
    c5: Sums,
    c6: Sums,
    c7: Sums,
}

fn add_row(first: vec2u, columns: TileColumns) -> TileColumns {
    let t0 = sums_of(source_integers(textureLoad(moments_map, first + vec2u(0u, 0u), 0)));
    let t1 = t0 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(1u, 0u), 0)));
    let t2 = t1 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(2u, 0u), 0)));
    let t3 = t2 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(3u, 0u), 0)));
    let t4 = t3 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(4u, 0u), 0)));
    let t5 = t4 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(5u, 0u), 0)));
    let t6 = t5 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(6u, 0u), 0)));
    let t7 = t6 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(7u, 0u), 0)));
    return TileColumns(columns.c0 + t0, columns.c1 + t1, columns.c2 + t2, columns.c3 + t3, columns.c4 + t4, columns.c5 + t5, columns.c6 + t6, columns.c7 + t7);
}

fn last_column(columns: TileColumns) -> Sums {
    return columns.c7;
}

fn load_columns(map: texture_2d<u32>, first: vec2u) -> TileColumns {
    return TileColumns(
        sums_of(textureLoad(map, first + vec2u(0u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(1u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(2u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(3u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(4u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(5u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(6u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(7u, 0u), 0)),
    );
}

fn store_columns(first: vec2u, count: u32, columns: TileColumns, added: Sums) {
    if 0u < count {
        textureStore(target_map, first + vec2u(0u, 0u), sums_texel(columns.c0 + added));
    }
    if 1u < count {
        textureStore(target_map, first + vec2u(1u, 0u), sums_texel(columns.c1 + added));
    }
    if 2u < count {
        textureStore(target_map, first + vec2u(2u, 0u), sums_texel(columns.c2 + added));
    }
    if 3u < count {
        textureStore(target_map, first + vec2u(3u, 0u), sums_texel(columns.c3 + added));
    }
    if 4u < count {
        textureStore(target_map, first + vec2u(4u, 0u), sums_texel(columns.c4 + added));
    }
    if 5u < count {
        textureStore(target_map, first + vec2u(5u, 0u), sums_texel(columns.c5 + added));
    }
    if 6u < count {
        textureStore(target_map, first + vec2u(6u, 0u), sums_texel(columns.c6 + added));
    }
    if 7u < count {
        textureStore(target_map, first + vec2u(7u, 0u), sums_texel(columns.c7 + added));
    }
}

// table.wgsl

// Last pass: the table, one tile per invocation. It begins with the row of the table above the tile; each row adds its own
// texels, and for what lies to the left the row prefix.

@group(GROUP) @binding(2) var row_prefixes: texture_2d<u32>;
@group(GROUP) @binding(3) var column_prefixes: texture_2d<u32>;

@compute @workgroup_size(WORKGROUP.x, WORKGROUP.y)
fn make_table(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let tile = region_tile(workgroup, workgroups, textureDimensions(target_map), 0u, WORKGROUP * TILE);
    let place = tile.first + local.xy * TILE;
    if any(place >= tile.region.extent) {
        return;
    }
    let first = tile.region.origin + place;
    // The places of the tiles to the left and above.
    let before = max((first + TILE - 1u) / TILE, vec2u(1u)) - 1u;
    var columns: TileColumns;
    if place.y > 0u {
        columns = load_columns(column_prefixes, vec2u(first.x, before.y));
    }
    let size = min(TILE, tile.region.extent - place);
    for (var row = 0u; row < size.y; row++) {
        let y = first.y + row;
        columns = add_row(vec2u(first.x, y), columns);
        var left: Sums;
        if place.x > 0u {
            left = sums_of(textureLoad(row_prefixes, vec2u(before.x, y), 0));
        }
        store_columns(vec2u(first.x, y), size.x, columns, left);
    }
}
