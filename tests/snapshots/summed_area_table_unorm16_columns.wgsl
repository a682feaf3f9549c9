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

// column_prefixes.wgsl

// Third pass: the rows of the table at the lower edges of tiles, one column of a region per invocation. To a tile's own sums
// up to the column those of the tiles to its left are added: the last of their row prefixes.

@group(GROUP) @binding(0) var column_sums: texture_2d<u32>;
@group(GROUP) @binding(1) var column_prefixes: SumsStorage;
@group(GROUP) @binding(2) var row_prefixes: texture_2d<u32>;

const LINES = 64u;

// The sums of a row of tiles, up to the column x.
fn tile_row_sum(x: u32, slot: u32, left: u32, last_row: u32, is_first: bool) -> Sums {
    let before = select(textureLoad(row_prefixes, vec2u(left, last_row), 0), vec4u(0u), is_first);
    return sums_of(textureLoad(column_sums, vec2u(x, slot), 0) + before);
}

@compute @workgroup_size(LINES)
fn sum_columns(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    // As far as tiles reach, which may be beyond the map.
    let size = textureDimensions(column_sums) * vec2u(1u, TILE.y);
    let lines = region_tile(workgroup, workgroups, size, 0u, vec2u(LINES, 65536u));
    let line = lines.first.x + local.x;
    if line >= lines.region.extent.x || lines.region.extent.y == 0u {
        return;
    }
    let x = lines.region.origin.x + line;
    let is_first = line < TILE.x;
    // The place of the tile to the left.
    let tile = (lines.region.origin.x + TILE.x - 1u) / TILE.x + line / TILE.x;
    let left = max(tile, 1u) - 1u;
    let first = (lines.region.origin.y + TILE.y - 1u) / TILE.y;
    let end = first + (lines.region.extent.y - 1u) / TILE.y;
    var last_row = lines.region.origin.y + TILE.y - 1u;
    var sum: Sums;
    // Two tiles at a time, with two loads each, hide each other's latency.
    for (var y = first; y < end; y += 2u) {
        let s0 = tile_row_sum(x, y, left, last_row, is_first);
        let s1 = tile_row_sum(x, y + 1u, left, last_row + TILE.y, is_first);
        sum += s0;
        textureStore(column_prefixes, vec2u(x, y), sums_texel(sum));
        sum += s1;
        if y + 1u < end {
            textureStore(column_prefixes, vec2u(x, y + 1u), sums_texel(sum));
        }
        last_row += 2u * TILE.y;
    }
}
