// What is linked of files:
// moment_shadows/maths/split_sum.wgsl: split_sum_coarse
// moment_shadows/filter/separable.wgsl: separable_add SeparableSums separable_add_to_sums SeparableEight separable_add_to_eight separable_outputs
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32 storage_round_to_float16
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels
// moment_shadows/moments/four_moments.wgsl: FOUR_MOMENTS_SQRT_3 four_moments_from_depth four_moments_quantize four_moments_to_texel
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth range_fit_map_depth
// range_of_region: range_of_region
// resolved: conversions depth_map resolved_channels
// blur_source: blur_source blur_stored
// map_texture: texel_to_texture
// blur_target: written_map blur_store_one blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// blur.wgsl: write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const FITTED = false;
alias DepthTexture = texture_depth_multisampled_2d;
const REGIONS = 1u;
const SAMPLES = 4;
const WORKGROUP_X = 8u;
const WORKGROUP_Y = 8u;
const AXIS = vec2i(1, 0);
const OUTPUTS = 16;
const SPLIT_SUMS = false;

// map_encoding
fn encoding_channels(z: f32) -> vec4f {
    return four_moments_from_depth(z);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
}

// blur_outputs
fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
    var sums: SeparableEight;
    var sums1: SeparableEight;
    sums = separable_add_to_eight(sums, blur_source(first + -4 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.044044495), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -3 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.044044495, 0.08086777), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -2 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + -1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 0 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.044044495), vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.044044495, 0.08086777), vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 2 * AXIS, low, last, region), vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 3 * AXIS, low, last, region), vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), SPLIT_SUMS, true);
    let t8 = blur_source(first + 4 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t8, vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t8, vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.044044495), SPLIT_SUMS, true);
    let t9 = blur_source(first + 5 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t9, vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t9, vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.044044495, 0.08086777), SPLIT_SUMS, true);
    let t10 = blur_source(first + 6 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t10, vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), vec4f(0.08086777, 0.044044495, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t10, vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), SPLIT_SUMS, true);
    let t11 = blur_source(first + 7 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t11, vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), vec4f(0.044044495, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t11, vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), SPLIT_SUMS, true);
    let t12 = blur_source(first + 8 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t12, vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t12, vec4f(0.0, 0.0, 0.0, 0.044044495), vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), SPLIT_SUMS, true);
    let t13 = blur_source(first + 9 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t13, vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t13, vec4f(0.0, 0.0, 0.044044495, 0.08086777), vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), SPLIT_SUMS, true);
    let t14 = blur_source(first + 10 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t14, vec4f(0.08086777, 0.044044495, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, t14, vec4f(0.0, 0.044044495, 0.08086777, 0.12482071), vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), SPLIT_SUMS, true);
    let t15 = blur_source(first + 11 * AXIS, low, last, region);
    sums = separable_add_to_eight(sums, t15, vec4f(0.044044495, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    blur_store(first, last, sums);
    sums1 = separable_add_to_eight(sums1, t15, vec4f(0.044044495, 0.08086777, 0.12482071, 0.16194916), vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 12 * AXIS, low, last, region), vec4f(0.08086777, 0.12482071, 0.16194916, 0.17663574), vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 13 * AXIS, low, last, region), vec4f(0.12482071, 0.16194916, 0.17663574, 0.16194916), vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 14 * AXIS, low, last, region), vec4f(0.16194916, 0.17663574, 0.16194916, 0.12482071), vec4f(0.08086777, 0.044044495, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 15 * AXIS, low, last, region), vec4f(0.17663574, 0.16194916, 0.12482071, 0.08086777), vec4f(0.044044495, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 16 * AXIS, low, last, region), vec4f(0.16194916, 0.12482071, 0.08086777, 0.044044495), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 17 * AXIS, low, last, region), vec4f(0.12482071, 0.08086777, 0.044044495, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 18 * AXIS, low, last, region), vec4f(0.08086777, 0.044044495, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums1 = separable_add_to_eight(sums1, blur_source(first + 19 * AXIS, low, last, region), vec4f(0.044044495, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    blur_store(first + 8 * AXIS, last, sums1);
}

