// What is linked of files:
// moment_shadows/maths/split_sum.wgsl: split_sum_coarse
// moment_shadows/filter/separable.wgsl: separable_add SeparableSums separable_add_to_sums SeparableEight separable_add_to_eight separable_outputs
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 STORAGE_PACKED64 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels packed_four_moments_from_channels
// moment_shadows/moments/four_moments.wgsl: four_moments_filter_value four_moments_filter_texel
// map_texture: texel_of_texture texel_to_texture
// blur_source: moments_map blur_source blur_stored
// blur_target: written_map blur_store_one blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// blur.wgsl: write_map

// specialization
const GROUP = 0;
alias MapTexture = texture_2d<f32>;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;
const WORKGROUP_X = 8u;
const WORKGROUP_Y = 8u;
const AXIS = vec2i(1, 0);
const OUTPUTS = 8;
const SPLIT_SUMS = false;

// map_filtering
fn filtering_value(texel: vec4f) -> vec4f {
    return four_moments_filter_value(texel, STORAGE);
}

// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return four_moments_filter_texel(value, STORAGE);
}

// blur_outputs
fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
    var sums: SeparableEight;
    sums = separable_add_to_eight(sums, blur_source(first + -1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.16637802), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 0 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.16637802, 0.66724396), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 1 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.0, 0.16637802, 0.66724396, 0.16637802), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 2 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.0), vec4f(0.16637802, 0.66724396, 0.16637802, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 3 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.0, 0.16637802), vec4f(0.66724396, 0.16637802, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 4 * AXIS, low, last, region), vec4f(0.0, 0.0, 0.16637802, 0.66724396), vec4f(0.16637802, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 5 * AXIS, low, last, region), vec4f(0.0, 0.16637802, 0.66724396, 0.16637802), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 6 * AXIS, low, last, region), vec4f(0.16637802, 0.66724396, 0.16637802, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 7 * AXIS, low, last, region), vec4f(0.66724396, 0.16637802, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    sums = separable_add_to_eight(sums, blur_source(first + 8 * AXIS, low, last, region), vec4f(0.16637802, 0.0, 0.0, 0.0), vec4f(0.0, 0.0, 0.0, 0.0), SPLIT_SUMS, true);
    blur_store(first, last, sums);
}

