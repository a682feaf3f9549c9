// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/filter/prefix_sum.wgsl: PrefixSumFour prefix_sum_along prefix_sum_across
// sums: target_map sums_texel sums_store_four
// moment_shadows/filter/summed_area_encoding.wgsl: summed_area_encoding_of_unorm16
// source: source_integers
// tile_columns: moments_map TileColumns load_texel load_four_texels add_row last_column store_columns
// tile_sums.wgsl: row_sums sum_tiles

// specialization
const GROUP = 0;
alias SumsStorage = texture_storage_2d<rgba32uint, write>;
const CHANNELS = 4u;
const REGIONS = 1u;
const TILE = vec2u(8u, 16u);
const WORKGROUP_X = 8u;
const WORKGROUP_Y = 8u;

