// What is linked of files:
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// blur_target: moments_map blurred_map blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// blur_unrolled.wgsl: blur

// specialization
const GROUP = 0;
const WORKGROUP_X = 8;
const WORKGROUP_Y = 8;
const AXIS = vec2i(1, 0);
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

// blur_unrolled
const OUTPUTS = 8;
fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> array<vec4f, 8> {
    let t0 = filtering_value(textureLoad(map, clamp(first + -1 * AXIS, low, last), 0));
    var o0 = 0.16637802 * t0;
    let t1 = filtering_value(textureLoad(map, clamp(first + 0 * AXIS, low, last), 0));
    o0 = fma(vec4f(0.66724396), t1, o0);
    var o1 = 0.16637802 * t1;
    let t2 = filtering_value(textureLoad(map, clamp(first + 1 * AXIS, low, last), 0));
    o0 = fma(vec4f(0.16637802), t2, o0);
    o1 = fma(vec4f(0.66724396), t2, o1);
    var o2 = 0.16637802 * t2;
    let t3 = filtering_value(textureLoad(map, clamp(first + 2 * AXIS, low, last), 0));
    o1 = fma(vec4f(0.16637802), t3, o1);
    o2 = fma(vec4f(0.66724396), t3, o2);
    var o3 = 0.16637802 * t3;
    let t4 = filtering_value(textureLoad(map, clamp(first + 3 * AXIS, low, last), 0));
    o2 = fma(vec4f(0.16637802), t4, o2);
    o3 = fma(vec4f(0.66724396), t4, o3);
    var o4 = 0.16637802 * t4;
    let t5 = filtering_value(textureLoad(map, clamp(first + 4 * AXIS, low, last), 0));
    o3 = fma(vec4f(0.16637802), t5, o3);
    o4 = fma(vec4f(0.66724396), t5, o4);
    var o5 = 0.16637802 * t5;
    let t6 = filtering_value(textureLoad(map, clamp(first + 5 * AXIS, low, last), 0));
    o4 = fma(vec4f(0.16637802), t6, o4);
    o5 = fma(vec4f(0.66724396), t6, o5);
    var o6 = 0.16637802 * t6;
    let t7 = filtering_value(textureLoad(map, clamp(first + 6 * AXIS, low, last), 0));
    o5 = fma(vec4f(0.16637802), t7, o5);
    o6 = fma(vec4f(0.66724396), t7, o6);
    var o7 = 0.16637802 * t7;
    let t8 = filtering_value(textureLoad(map, clamp(first + 7 * AXIS, low, last), 0));
    o6 = fma(vec4f(0.16637802), t8, o6);
    o7 = fma(vec4f(0.66724396), t8, o7);
    let t9 = filtering_value(textureLoad(map, clamp(first + 8 * AXIS, low, last), 0));
    o7 = fma(vec4f(0.16637802), t9, o7);
    return array<vec4f, 8>(o0, o1, o2, o3, o4, o5, o6, o7);
}

