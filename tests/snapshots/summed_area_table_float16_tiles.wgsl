// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/filter/prefix_sum.wgsl: PrefixSumFour prefix_sum_along prefix_sum_across
// sums: target_map sums_texel sums_store_four
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32 storage_is_float storage_round_to_float16 storage_finite_texel
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels
// moment_shadows/moments/four_moments.wgsl: FOUR_MOMENTS_SQRT_3 four_moments_quantize four_moments_clamp four_moments_to_texel
// moment_shadows/filter/summed_area_encoding.wgsl: summed_area_encoding_of_channels
// source: source_integers
// tile_columns: moments_map TileColumns load_texel load_four_texels add_row last_column store_columns
// tile_sums.wgsl: row_sums sum_tiles

// specialization
const GROUP = 0;
alias SumsStorage = texture_storage_2d<rgba32uint, write>;
const SOURCE_STORAGE = 1u;
const STORAGE = 0u;
const UNIT = 1016560u;
const CHANNELS = 4u;
const REGIONS = 1u;
const TILE = vec2u(8u, 16u);
const WORKGROUP_X = 8u;
const WORKGROUP_Y = 8u;

// map_encoding
// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
}

