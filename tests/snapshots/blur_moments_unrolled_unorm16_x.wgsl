// moment_shadows/moments.wgsl
// Four moments of depth: encoding, storage, bias.
//
// A texel holds b = (E[z], E[z^2], E[z^3], E[z^4]) of the moment depths z in [-1, 1] that it covers (Peters & Klein,
// "Moment Shadow Mapping", i3D 2015, section 2). Linear filters keep moments valid as long as their weights are not
// negative and sum to one. Storage with few bits holds an affine image of the moments that spreads them over the range
// of every channel (Peters, GDC 2016; JCGT 6(1) 2017, section 3); affine maps commute with filtering.

// A moment bias: b is moved by alpha towards (0, beta, 0, beta), which pulls moments that rounding has made
// impossible back among the possible ones. (0, beta, 0, beta) are the moments of occluders at the near end, the middle
// and the far end with the weights beta/2, 1 - beta and beta/2.
struct MomentBias {
    alpha: f32,
    beta: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur,
// every stage rounded to the storage; beta is optimal for the basis (JCGT 6(1) 2017, section 3).
const MOMENTS_BIAS_UNORM16: MomentBias = MomentBias(6e-5, 0.628);
const MOMENTS_BIAS_FLOAT16: MomentBias = MomentBias(1e-3, 0.628);
const MOMENTS_BIAS_FLOAT32: MomentBias = MomentBias(1.5e-6, 0.375);

// Storages, as a shader's specialisation names them.
const MOMENTS_STORAGE_UNORM16: u32 = 0u;
const MOMENTS_STORAGE_FLOAT16: u32 = 1u;
const MOMENTS_STORAGE_FLOAT32: u32 = 2u;

// sqrt(3), which the optimised basis and its inverse are made of.
const MOMENTS_SQRT_3: f32 = 1.7320508075688772;

// The moments of a single depth z in [-1, 1]: its powers (i3D 2015, equation 2).
fn moments_from_depth(z: f32) -> vec4f {
    let square = z * z;
    return vec4f(z, square, z * square, square * square);
}

// The optimised basis of JCGT 6(1) 2017 (equation 5, GDC 2016): maps the moments of depths in [-1, 1] into [0, 1]^4.
fn moments_quantize(b: vec4f) -> vec4f {
    return vec4f(
        fma(1.5, b.x, fma(-2.0, b.z, 0.5)),
        4.0 * (b.y - b.w),
        fma(0.5 * MOMENTS_SQRT_3, b.x, fma(-2.0 / 9.0 * MOMENTS_SQRT_3, b.z, 0.5)),
        0.5 * (b.y + b.w),
    );
}

// Inverse of `moments_quantize`. Channels in [0, 1] give |b| <= 2.1, whatever they hold.
fn moments_dequantize(channels: vec4f) -> vec4f {
    let odd = channels.xz - 0.5;
    return vec4f(
        fma(-1.0 / 3.0, odd.x, MOMENTS_SQRT_3 * odd.y),
        fma(0.125, channels.y, channels.w),
        0.75 * fma(MOMENTS_SQRT_3, odd.y, -odd.x),
        fma(-0.125, channels.y, channels.w),
    );
}

// The nearest float16 of each component, ties to even, for |value| < 65504. A driver may truncate when it stores to a
// float16 texture, which would double the rounding error that the bias has to cover.
fn moments_round_to_float16(value: vec4f) -> vec4f {
    let bits = bitcast<vec4u>(value);
    // 13 of 23 mantissa bits go; adding just under half a unit, plus the last kept bit, rounds ties to even.
    let rounded = bitcast<vec4f>((bits + 0xfffu + ((bits >> vec4u(13u)) & vec4u(1u))) & vec4u(0xffffe000u));
    // Below 2^-14 float16 is a fixed-point format with a step of 2^-24.
    let small = round(value * 0x1p24) * 0x1p-24;
    return select(rounded, small, abs(value) < vec4f(0x1p-14));
}

// Moments that certainly lie in their ranges: odd ones in [-1, 1], even ones in [0, 1]. Float storage can hold
// anything, and finite values beyond 1e15 would overflow further on.
fn moments_clamp(b: vec4f) -> vec4f {
    return clamp(b, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// What to write to a texel of the storage.
fn moments_to_texel(b: vec4f, storage: u32) -> vec4f {
    if storage == MOMENTS_STORAGE_FLOAT32 {
        return b;
    }
    let channels = saturate(moments_quantize(b));
    if storage == MOMENTS_STORAGE_FLOAT16 {
        // Half precision is finest around zero, so the channels are centred there.
        return moments_round_to_float16(channels - 0.5);
    }
    return channels;
}

// A filtered combination of texels, as it has to be written back to the same storage.
fn moments_round_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == MOMENTS_STORAGE_FLOAT16 {
        return moments_round_to_float16(texel);
    }
    return texel;
}

// The moments in a (filtered) texel of the storage. Float storage can hold anything; `moments_clamp` comes before any
// arithmetic that relies on ranges.
fn moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == MOMENTS_STORAGE_FLOAT32 {
        return texel;
    }
    if storage == MOMENTS_STORAGE_FLOAT16 {
        return moments_dequantize(texel + 0.5);
    }
    return moments_dequantize(texel);
}

// The moment bias of a storage.
fn moments_bias_of(storage: u32) -> MomentBias {
    if storage == MOMENTS_STORAGE_FLOAT32 {
        return MOMENTS_BIAS_FLOAT32;
    }
    if storage == MOMENTS_STORAGE_FLOAT16 {
        return MOMENTS_BIAS_FLOAT16;
    }
    return MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn moments_apply_bias(b: vec4f, bias: MomentBias) -> vec4f {
    return fma(vec4f(bias.alpha), vec4f(0.0, bias.beta, 0.0, bias.beta) - b, b);
}

// The biased moments in a (filtered) texel of the storage, with the storage's own bias, within [-2.1, 2.1]: for unorm
// storage if the channels are in [0, 1], as no texture can help, and for float storage whatever finite numbers it holds.
fn moments_biased_from_texel(texel: vec4f, storage: u32) -> vec4f {
    let bias = moments_bias_of(storage);
    if storage == MOMENTS_STORAGE_FLOAT32 {
        return moments_apply_bias(moments_clamp(texel), bias);
    }
    // The inverse of the basis and the bias are both affine, and so one step. These biases are large enough for 1 - alpha.
    let keep = 1.0 - bias.alpha;
    let of_xy = keep * vec4f(-1.0 / 3.0, 0.125, -0.75, -0.125);
    let of_zw = keep * vec4f(MOMENTS_SQRT_3, 1.0, 0.75 * MOMENTS_SQRT_3, 1.0);
    // Odd moments are 0 for channels of one half, and float16 storage holds one half less.
    let middle = select(vec4f(-0.5, 0.0, -0.5, 0.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == MOMENTS_STORAGE_FLOAT16);
    let shift = fma(middle, of_xy + of_zw, bias.alpha * vec4f(0.0, bias.beta, 0.0, bias.beta));
    let biased = fma(of_xy, texel.xyxy, fma(of_zw, texel.zwzw, shift));
    if storage == MOMENTS_STORAGE_FLOAT16 {
        return moments_clamp(biased);
    }
    return biased;
}

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const WORKGROUP_X = 8;
const WORKGROUP_Y = 8;
const AXIS = vec2i(1, 0);
const REGIONS = 1u;
const OUTPUTS = 8;
fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> array<vec4f, 8> {
    let t0 = textureLoad(map, clamp(first + -1 * AXIS, low, last), 0);
    var o0 = 0.16637853 * t0;
    let t1 = textureLoad(map, clamp(first + 0 * AXIS, low, last), 0);
    o0 = fma(vec4f(0.66724294), t1, o0);
    var o1 = 0.16637853 * t1;
    let t2 = textureLoad(map, clamp(first + 1 * AXIS, low, last), 0);
    o0 = fma(vec4f(0.16637853), t2, o0);
    o1 = fma(vec4f(0.66724294), t2, o1);
    var o2 = 0.16637853 * t2;
    let t3 = textureLoad(map, clamp(first + 2 * AXIS, low, last), 0);
    o1 = fma(vec4f(0.16637853), t3, o1);
    o2 = fma(vec4f(0.66724294), t3, o2);
    var o3 = 0.16637853 * t3;
    let t4 = textureLoad(map, clamp(first + 3 * AXIS, low, last), 0);
    o2 = fma(vec4f(0.16637853), t4, o2);
    o3 = fma(vec4f(0.66724294), t4, o3);
    var o4 = 0.16637853 * t4;
    let t5 = textureLoad(map, clamp(first + 4 * AXIS, low, last), 0);
    o3 = fma(vec4f(0.16637853), t5, o3);
    o4 = fma(vec4f(0.66724294), t5, o4);
    var o5 = 0.16637853 * t5;
    let t6 = textureLoad(map, clamp(first + 5 * AXIS, low, last), 0);
    o4 = fma(vec4f(0.16637853), t6, o4);
    o5 = fma(vec4f(0.66724294), t6, o5);
    var o6 = 0.16637853 * t6;
    let t7 = textureLoad(map, clamp(first + 6 * AXIS, low, last), 0);
    o5 = fma(vec4f(0.16637853), t7, o5);
    o6 = fma(vec4f(0.66724294), t7, o6);
    var o7 = 0.16637853 * t7;
    let t8 = textureLoad(map, clamp(first + 7 * AXIS, low, last), 0);
    o6 = fma(vec4f(0.16637853), t8, o6);
    o7 = fma(vec4f(0.66724294), t8, o7);
    let t9 = textureLoad(map, clamp(first + 8 * AXIS, low, last), 0);
    o7 = fma(vec4f(0.16637853), t9, o7);
    return array<vec4f, 8>(o0, o1, o2, o3, o4, o5, o6, o7);
}

// blur_target

// Where a direction of the blur reads and writes: one layer each.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;
@group(GROUP) @binding(1) var blurred_map: MomentsStorage;

// Stores a filtered texel unless it lies beyond `last`, the last texel of the region.
fn blur_store(texel: vec2i, last: vec2i, value: vec4f) {
    if all(texel <= last) {
        textureStore(blurred_map, texel, moments_round_texel(value, STORAGE));
    }
}

// moment_shadows/map_region.wgsl
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

// blur_moments_unrolled.wgsl

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
