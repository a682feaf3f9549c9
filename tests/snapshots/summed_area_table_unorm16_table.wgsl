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
alias SumsStorage = texture_storage_2d<rgba32uint, write>;

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

// moment_shadows/filter/summed_area_encoding.wgsl

// The integers that a summed-area table sums up, and how exact the means are that come back.
//
// Channels are those of the storage unorm16: in [0, 1], with the optimised basis. From a unorm16 map they are its own 16-bit
// integers, with the unit 65535 and no rounding beyond the map's. Other maps are rounded to multiples of 1 / unit with
// unit = floor((2^32 - 1) / n) less the bits that f32 would round, n being the texels of the largest kernel: not 2^32 / n,
// since n channels of exactly 1, as every region without a caster has, would then wrap around to 0 (Peters et al.,
// JCGT 6(1) 2017, section 4).

// The 16-bit integers of a texel of unorm16.
fn summed_area_encoding_of_unorm16(texel: vec4f) -> vec4u {
    // At 2^23 the last bit of the mantissa is 1: adding that rounds, and leaves the integer in the low bits.
    return bitcast<vec4u>(fma(texel, vec4f(65535.0), vec4f(0x1p23))) & vec4u(0xffffu);
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
