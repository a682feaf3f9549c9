// What is linked of files:
// moment_shadows/maths/split_sum.wgsl: split_sum_coarse
// moment_shadows/filter/separable.wgsl: separable_add SeparableSums separable_add_to_sums SeparableEight separable_add_to_eight separable_outputs SeparableSixteen separable_add_to_sixteen
// blur_parameters: BlurParameters parameters
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// blur_source: blur_source
// blur_target: moments_map blurred_map blur_store_one blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// blur_uniform.wgsl: blur_four blur

// specialization
const GROUP = 0;
const WORKGROUP_X = 8;
const WORKGROUP_Y = 8;
const AXIS = vec2i(1, 0);
const OUTPUTS = 16;
const SPLIT_SUMS = false;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;

// map_filtering
fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

