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

// row_prefixes.wgsl

// Second pass: prefix sums of the tiles' row sums, one row of a region per invocation. A prefix lies where the last tile lies
// that it contains.

@group(GROUP) @binding(0) var row_sums: texture_2d<u32>;
@group(GROUP) @binding(1) var row_prefixes: SumsStorage;

const LINES = 64u;

@compute @workgroup_size(LINES)
fn sum_rows(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    // As far as tiles reach, which may be beyond the map.
    let size = textureDimensions(row_sums) * vec2u(TILE.x, 1u);
    let lines = region_tile(workgroup, workgroups, size, 0u, vec2u(65536u, LINES));
    let line = lines.first.y + local.x;
    if line >= lines.region.extent.y || lines.region.extent.x == 0u {
        return;
    }
    let y = lines.region.origin.y + line;
    let first = (lines.region.origin.x + TILE.x - 1u) / TILE.x;
    // Beyond the last tile is none that would need its sum.
    let end = first + (lines.region.extent.x - 1u) / TILE.x;
    var sum: Sums;
    // Four loads at a time hide each other's latency.
    for (var x = first; x < end; x += 4u) {
        let t0 = sums_of(textureLoad(row_sums, vec2u(x, y), 0));
        let t1 = sums_of(textureLoad(row_sums, vec2u(x + 1u, y), 0));
        let t2 = sums_of(textureLoad(row_sums, vec2u(x + 2u, y), 0));
        let t3 = sums_of(textureLoad(row_sums, vec2u(x + 3u, y), 0));
        sum += t0;
        textureStore(row_prefixes, vec2u(x, y), sums_texel(sum));
        sum += t1;
        if x + 1u < end {
            textureStore(row_prefixes, vec2u(x + 1u, y), sums_texel(sum));
        }
        sum += t2;
        if x + 2u < end {
            textureStore(row_prefixes, vec2u(x + 2u, y), sums_texel(sum));
        }
        sum += t3;
        if x + 3u < end {
            textureStore(row_prefixes, vec2u(x + 3u, y), sums_texel(sum));
        }
    }
}
