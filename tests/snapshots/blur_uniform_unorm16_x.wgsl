// What is linked of files:
// moment_shadows/maths/split_sum.wgsl: split_sum_coarse
// moment_shadows/filter/separable.wgsl: separable_add SeparableSums separable_add_to_sums SeparableEight separable_add_to_eight separable_outputs SeparableSixteen separable_add_to_sixteen
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 STORAGE_PACKED64 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels packed_four_moments_from_channels
// moment_shadows/moments/four_moments.wgsl: four_moments_filter_value four_moments_filter_texel
// map_texture: texel_of_texture texel_to_texture
// blur_source: moments_map BlurParameters parameters blur_kernel blur_source blur_stored
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
const KERNELS = 1u;
const WORKGROUP_X = 8u;
const WORKGROUP_Y = 8u;
const AXIS = vec2i(1, 0);
const OUTPUTS = 16;
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
// Adds the four texels from `texel` on, whose weights begin in `w0`.
fn blur_four(sums: SeparableSixteen, texel: vec2i, low: vec2i, last: vec2i, region: u32, w0: vec4f, w1: vec4f, w2: vec4f, w3: vec4f, w4: vec4f) -> SeparableSixteen {
    let t0 = blur_source(texel, low, last, region);
    let s0 = separable_add_to_sixteen(sums, t0, w0, w1, w2, w3, SPLIT_SUMS);
    let t1 = blur_source(texel + AXIS, low, last, region);
    let s1 = separable_add_to_sixteen(s0, t1, vec4f(w0.yzw, w1.x), vec4f(w1.yzw, w2.x), vec4f(w2.yzw, w3.x), vec4f(w3.yzw, w4.x), SPLIT_SUMS);
    let t2 = blur_source(texel + 2 * AXIS, low, last, region);
    let s2 = separable_add_to_sixteen(s1, t2, vec4f(w0.zw, w1.xy), vec4f(w1.zw, w2.xy), vec4f(w2.zw, w3.xy), vec4f(w3.zw, w4.xy), SPLIT_SUMS);
    let t3 = blur_source(texel + 3 * AXIS, low, last, region);
    return separable_add_to_sixteen(s2, t3, vec4f(w0.w, w1.xyz), vec4f(w1.w, w2.xyz), vec4f(w2.w, w3.xyz), vec4f(w3.w, w4.xyz), SPLIT_SUMS);
}

// Stores the outputs from the texel `first` on.
fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
    let kernel = blur_kernel(region);
    var sums: SeparableSixteen;
    var w0 = parameters[kernel].weights[0];
    var w1 = parameters[kernel].weights[1];
    var w2 = parameters[kernel].weights[2];
    var w3 = parameters[kernel].weights[3];
    // 40 vectors of weights hold 9 blocks.
    let blocks = min(parameters[kernel].blocks, 9u);
    for (var block_index = 0u; block_index < blocks; block_index++) {
        let w4 = parameters[kernel].weights[4u * block_index + 4u];
        let w5 = parameters[kernel].weights[4u * block_index + 5u];
        let w6 = parameters[kernel].weights[4u * block_index + 6u];
        let w7 = parameters[kernel].weights[4u * block_index + 7u];
        let texel = first + (i32(16u * block_index) - i32(parameters[kernel].radius)) * AXIS;
        sums = blur_four(sums, texel, low, last, region, w0, w1, w2, w3, w4);
        sums = blur_four(sums, texel + 4 * AXIS, low, last, region, w1, w2, w3, w4, w5);
        sums = blur_four(sums, texel + 8 * AXIS, low, last, region, w2, w3, w4, w5, w6);
        sums = blur_four(sums, texel + 12 * AXIS, low, last, region, w3, w4, w5, w6, w7);
        w0 = w4;
        w1 = w5;
        w2 = w6;
        w3 = w7;
    }
    blur_store(first, last, sums.first);
    blur_store(first + 8 * AXIS, last, sums.second);
}

