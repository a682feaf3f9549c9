// What is linked of files:
// moment_shadows/maths/split_sum.wgsl: split_sum_coarse
// moment_shadows/filter/separable.wgsl: separable_add SeparableSums separable_add_to_sums SeparableEight separable_add_to_eight separable_outputs
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32 storage_unpack storage_round_to_float16
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels packed_four_moments_from_channels
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16 FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16 FOUR_MOMENTS_SQRT_3 four_moments_quantize four_moments_clamp four_moments_to_texel four_moments_apply_bias four_moments_biased_from_texel
// moment_shadows/moments/inward_rounding.wgsl: INWARD_ROUNDING_SHARE INWARD_ROUNDING_MOVE INWARD_ROUNDING_INVALID inward_rounding_least_key inward_rounding_best inward_rounding_texel
// blur_source: moments_map blur_source blur_stored
// moment_shadows/moments/coarse_four_moments.wgsl: COARSE_FOUR_MOMENTS_DEPTHS COARSE_FOUR_MOMENTS_DISTANCES COARSE_FOUR_MOMENTS_WEIGHTS COARSE_FOUR_MOMENTS_PIVOTS COARSE_FOUR_MOMENTS_SLACK coarse_four_moments_pack
// map_texture: texel_to_texture
// blur_target: written_map blur_store_one blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// blur.wgsl: write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<r32uint, write>;
const STORAGE = 7u;
const REGIONS = 1u;
const ROUNDED_INWARDS = false;
const WORKGROUP_X = 64u;
const WORKGROUP_Y = 1u;
const AXIS = vec2i(0, 1);
const OUTPUTS = 8;
const SPLIT_SUMS = false;

// map_encoding
// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
}

// blur_outputs
fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
    var sums: SeparableEight;
    sums = separable_add_to_eight(sums, blur_source(first + -4 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.044044495), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -3 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.044044495, 0.08086777), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -2 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 0 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.044044495), vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.044044495, 0.08086777), vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 2 * AXIS, low, last, region), vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 3 * AXIS, low, last, region), vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 4 * AXIS, low, last, region), vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 5 * AXIS, low, last, region), vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 6 * AXIS, low, last, region), vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), vec4f(0.08086777, 0.044044495, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 7 * AXIS, low, last, region), vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), vec4f(0.044044495, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 8 * AXIS, low, last, region), vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 9 * AXIS, low, last, region), vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 10 * AXIS, low, last, region), vec4f(0.08086777, 0.044044495, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 11 * AXIS, low, last, region), vec4f(0.044044495, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    blur_store(first, last, sums);
}

