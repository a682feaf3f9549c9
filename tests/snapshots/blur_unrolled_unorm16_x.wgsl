// specialization
const GROUP = 0;
const WORKGROUP_X = 8;
const WORKGROUP_Y = 8;
const AXIS = vec2i(1, 0);
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;

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

// map_filtering

// Texels that any filter averages.

fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

// blur_target

// Where a direction of the blur reads and writes: one layer each.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;
@group(GROUP) @binding(1) var blurred_map: MomentsStorage;

// Stores a filtered texel unless it lies beyond `last`, the last texel of the region.
fn blur_store(texel: vec2i, last: vec2i, value: vec4f) {
    if all(texel <= last) {
        textureStore(blurred_map, texel, filtering_texel(value));
    }
}

// blur_unrolled

const OUTPUTS = 8;
fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> array<vec4f, 8> {
    let t0 = filtering_value(textureLoad(map, clamp(first + -1 * AXIS, low, last), 0));
    var o0 = 0.16637802 * t0;
    let t1 = filtering_value(textureLoad(map, clamp(first + 0 * AXIS, low, last), 0));
    o0 = fma(vec4f(0.66724396), t1, o0);
    var o1 = 0.16637802 * t1;
    let t2 = filtering_value(textureLoad(map, clamp(first + 1 * AXIS, low, last), 0));
    o0 = fma(vec4f(0.16637802), t2, o0);
    o1 = fma(vec4f(0.66724396), t2, o1);
    var o2 = 0.16637802 * t2;
    let t3 = filtering_value(textureLoad(map, clamp(first + 2 * AXIS, low, last), 0));
    o1 = fma(vec4f(0.16637802), t3, o1);
    o2 = fma(vec4f(0.66724396), t3, o2);
    var o3 = 0.16637802 * t3;
    let t4 = filtering_value(textureLoad(map, clamp(first + 3 * AXIS, low, last), 0));
    o2 = fma(vec4f(0.16637802), t4, o2);
    o3 = fma(vec4f(0.66724396), t4, o3);
    var o4 = 0.16637802 * t4;
    let t5 = filtering_value(textureLoad(map, clamp(first + 4 * AXIS, low, last), 0));
    o3 = fma(vec4f(0.16637802), t5, o3);
    o4 = fma(vec4f(0.66724396), t5, o4);
    var o5 = 0.16637802 * t5;
    let t6 = filtering_value(textureLoad(map, clamp(first + 5 * AXIS, low, last), 0));
    o4 = fma(vec4f(0.16637802), t6, o4);
    o5 = fma(vec4f(0.66724396), t6, o5);
    var o6 = 0.16637802 * t6;
    let t7 = filtering_value(textureLoad(map, clamp(first + 6 * AXIS, low, last), 0));
    o5 = fma(vec4f(0.16637802), t7, o5);
    o6 = fma(vec4f(0.66724396), t7, o6);
    var o7 = 0.16637802 * t7;
    let t8 = filtering_value(textureLoad(map, clamp(first + 7 * AXIS, low, last), 0));
    o6 = fma(vec4f(0.16637802), t8, o6);
    o7 = fma(vec4f(0.66724396), t8, o7);
    let t9 = filtering_value(textureLoad(map, clamp(first + 8 * AXIS, low, last), 0));
    o7 = fma(vec4f(0.16637802), t9, o7);
    return array<vec4f, 8>(o0, o1, o2, o3, o4, o5, o6, o7);
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

// blur_unrolled.wgsl

// One direction of a separable filter over the regions of one layer, with weights that are known when the graph is compiled.
// An invocation makes OUTPUTS texels in a row along AXIS, out of texels that it loads once.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn blur(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let outputs = vec2u(1 + (OUTPUTS - 1) * AXIS);
    let tile = region_tile(workgroup, workgroups, textureDimensions(blurred_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * outputs);
    let place = tile.first + local.xy * outputs;
    if any(place >= tile.region.extent) {
        return;
    }
    let low = vec2i(tile.region.origin);
    let last = low + vec2i(tile.region.extent) - 1;
    let first = low + vec2i(place);
    let block = blur_block(moments_map, first, low, last);
    blur_store(first, last, block[0]);
    blur_store(first + AXIS, last, block[1]);
    blur_store(first + 2 * AXIS, last, block[2]);
    blur_store(first + 3 * AXIS, last, block[3]);
    blur_store(first + 4 * AXIS, last, block[4]);
    blur_store(first + 5 * AXIS, last, block[5]);
    blur_store(first + 6 * AXIS, last, block[6]);
    blur_store(first + 7 * AXIS, last, block[7]);
}
