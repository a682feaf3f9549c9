// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// sums: Sums sums_of sums_texel
// row_prefixes.wgsl: row_sums row_prefixes LINES sum_rows

// specialization
const GROUP = 0;
alias SumsStorage = texture_storage_2d<rgba32uint, write>;

const TILE = vec2u(8u, 16u);

const REGIONS = 1u;

