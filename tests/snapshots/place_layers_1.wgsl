// What is linked of files:
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/techniques/layered_variance.wgsl: LAYERED_VARIANCE_LARGEST_COUNT LayeredVarianceLayers layered_variance_split layered_variance_count
// moment_shadows/techniques/lloyd.wgsl: LloydState lloyd_wanted_split lloyd_second_split lloyd_cell lloyd_share lloyd_contribution lloyd_moved lloyd_teleported lloyd_step
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at
// place_layers.wgsl: conversions depth_map state_map target_map sums_map splits_map TILE SIDE INVOCATIONS PlacedState state_at_first state_before partial_sums sum_of_workgroup depth_at footprint_sums sum_tiles step_splits keep_splits

// specialization
const GROUP = 0;
alias DepthTexture = texture_depth_2d;
const REGIONS = 1u;
const LAYERS = 4u;

