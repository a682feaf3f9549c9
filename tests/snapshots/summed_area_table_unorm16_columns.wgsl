// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// sums: target_map sums_texel
// column_prefixes.wgsl: column_sums row_prefixes LINES tile_row_sum sum_columns

// specialization
const GROUP = 0;
alias SumsStorage = texture_storage_2d<rgba32uint, write>;
const CHANNELS = 4u;
const REGIONS = 1u;
const TILE = vec2u(8u, 16u);

