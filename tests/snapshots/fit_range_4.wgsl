// What is linked of files:
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at
// seen: conversions NOTHING_SEEN seen_conversion seen_end
// fit_range.wgsl: depth_map ranges_map target_map ends_map SIDE INVOCATIONS ROOM_BEHIND LEAST_BEHIND ROOM_IN_FRONT STEPS LONGEST SHORTEST NO_CASTER NO_ENDS partial_ends both_ends ends_of_workgroup ends_of_texel find_ends ends_of_region power_of_two range_around on_grid fitted fit_ranges range_of_region keep_ranges

// specialization
const GROUP = 0;
alias DepthTexture = texture_depth_multisampled_2d;
const REGIONS = 1u;
const SAMPLES = 4;

