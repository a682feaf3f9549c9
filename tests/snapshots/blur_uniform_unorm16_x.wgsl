// What is linked of files:
// blur_parameters: BlurParameters parameters
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// blur_target: moments_map blurred_map blur_store
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// blur_uniform.wgsl: blur

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
const OUTPUTS = 16;
struct BlurSums {
    o0: vec4f,
    o1: vec4f,
    o2: vec4f,
    o3: vec4f,
    o4: vec4f,
    o5: vec4f,
    o6: vec4f,
    o7: vec4f,
    o8: vec4f,
    o9: vec4f,
    o10: vec4f,
    o11: vec4f,
    o12: vec4f,
    o13: vec4f,
    o14: vec4f,
    o15: vec4f,
}
fn blur_taps(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i, sums: BlurSums, w0: vec4f, w1: vec4f, w2: vec4f, w3: vec4f, w4: vec4f, w5: vec4f, w6: vec4f, w7: vec4f) -> BlurSums {
    var o0 = sums.o0;
    var o1 = sums.o1;
    var o2 = sums.o2;
    var o3 = sums.o3;
    var o4 = sums.o4;
    var o5 = sums.o5;
    var o6 = sums.o6;
    var o7 = sums.o7;
    var o8 = sums.o8;
    var o9 = sums.o9;
    var o10 = sums.o10;
    var o11 = sums.o11;
    var o12 = sums.o12;
    var o13 = sums.o13;
    var o14 = sums.o14;
    var o15 = sums.o15;
    let t0 = filtering_value(textureLoad(map, clamp(first + 0 * AXIS, low, last), 0));
    o0 = fma(vec4f(w3.w), t0, o0);
    o1 = fma(vec4f(w3.z), t0, o1);
    o2 = fma(vec4f(w3.y), t0, o2);
    o3 = fma(vec4f(w3.x), t0, o3);
    o4 = fma(vec4f(w2.w), t0, o4);
    o5 = fma(vec4f(w2.z), t0, o5);
    o6 = fma(vec4f(w2.y), t0, o6);
    o7 = fma(vec4f(w2.x), t0, o7);
    o8 = fma(vec4f(w1.w), t0, o8);
    o9 = fma(vec4f(w1.z), t0, o9);
    o10 = fma(vec4f(w1.y), t0, o10);
    o11 = fma(vec4f(w1.x), t0, o11);
    o12 = fma(vec4f(w0.w), t0, o12);
    o13 = fma(vec4f(w0.z), t0, o13);
    o14 = fma(vec4f(w0.y), t0, o14);
    o15 = fma(vec4f(w0.x), t0, o15);
    let t1 = filtering_value(textureLoad(map, clamp(first + 1 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.x), t1, o0);
    o1 = fma(vec4f(w3.w), t1, o1);
    o2 = fma(vec4f(w3.z), t1, o2);
    o3 = fma(vec4f(w3.y), t1, o3);
    o4 = fma(vec4f(w3.x), t1, o4);
    o5 = fma(vec4f(w2.w), t1, o5);
    o6 = fma(vec4f(w2.z), t1, o6);
    o7 = fma(vec4f(w2.y), t1, o7);
    o8 = fma(vec4f(w2.x), t1, o8);
    o9 = fma(vec4f(w1.w), t1, o9);
    o10 = fma(vec4f(w1.z), t1, o10);
    o11 = fma(vec4f(w1.y), t1, o11);
    o12 = fma(vec4f(w1.x), t1, o12);
    o13 = fma(vec4f(w0.w), t1, o13);
    o14 = fma(vec4f(w0.z), t1, o14);
    o15 = fma(vec4f(w0.y), t1, o15);
    let t2 = filtering_value(textureLoad(map, clamp(first + 2 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.y), t2, o0);
    o1 = fma(vec4f(w4.x), t2, o1);
    o2 = fma(vec4f(w3.w), t2, o2);
    o3 = fma(vec4f(w3.z), t2, o3);
    o4 = fma(vec4f(w3.y), t2, o4);
    o5 = fma(vec4f(w3.x), t2, o5);
    o6 = fma(vec4f(w2.w), t2, o6);
    o7 = fma(vec4f(w2.z), t2, o7);
    o8 = fma(vec4f(w2.y), t2, o8);
    o9 = fma(vec4f(w2.x), t2, o9);
    o10 = fma(vec4f(w1.w), t2, o10);
    o11 = fma(vec4f(w1.z), t2, o11);
    o12 = fma(vec4f(w1.y), t2, o12);
    o13 = fma(vec4f(w1.x), t2, o13);
    o14 = fma(vec4f(w0.w), t2, o14);
    o15 = fma(vec4f(w0.z), t2, o15);
    let t3 = filtering_value(textureLoad(map, clamp(first + 3 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.z), t3, o0);
    o1 = fma(vec4f(w4.y), t3, o1);
    o2 = fma(vec4f(w4.x), t3, o2);
    o3 = fma(vec4f(w3.w), t3, o3);
    o4 = fma(vec4f(w3.z), t3, o4);
    o5 = fma(vec4f(w3.y), t3, o5);
    o6 = fma(vec4f(w3.x), t3, o6);
    o7 = fma(vec4f(w2.w), t3, o7);
    o8 = fma(vec4f(w2.z), t3, o8);
    o9 = fma(vec4f(w2.y), t3, o9);
    o10 = fma(vec4f(w2.x), t3, o10);
    o11 = fma(vec4f(w1.w), t3, o11);
    o12 = fma(vec4f(w1.z), t3, o12);
    o13 = fma(vec4f(w1.y), t3, o13);
    o14 = fma(vec4f(w1.x), t3, o14);
    o15 = fma(vec4f(w0.w), t3, o15);
    let t4 = filtering_value(textureLoad(map, clamp(first + 4 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.w), t4, o0);
    o1 = fma(vec4f(w4.z), t4, o1);
    o2 = fma(vec4f(w4.y), t4, o2);
    o3 = fma(vec4f(w4.x), t4, o3);
    o4 = fma(vec4f(w3.w), t4, o4);
    o5 = fma(vec4f(w3.z), t4, o5);
    o6 = fma(vec4f(w3.y), t4, o6);
    o7 = fma(vec4f(w3.x), t4, o7);
    o8 = fma(vec4f(w2.w), t4, o8);
    o9 = fma(vec4f(w2.z), t4, o9);
    o10 = fma(vec4f(w2.y), t4, o10);
    o11 = fma(vec4f(w2.x), t4, o11);
    o12 = fma(vec4f(w1.w), t4, o12);
    o13 = fma(vec4f(w1.z), t4, o13);
    o14 = fma(vec4f(w1.y), t4, o14);
    o15 = fma(vec4f(w1.x), t4, o15);
    let t5 = filtering_value(textureLoad(map, clamp(first + 5 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.x), t5, o0);
    o1 = fma(vec4f(w4.w), t5, o1);
    o2 = fma(vec4f(w4.z), t5, o2);
    o3 = fma(vec4f(w4.y), t5, o3);
    o4 = fma(vec4f(w4.x), t5, o4);
    o5 = fma(vec4f(w3.w), t5, o5);
    o6 = fma(vec4f(w3.z), t5, o6);
    o7 = fma(vec4f(w3.y), t5, o7);
    o8 = fma(vec4f(w3.x), t5, o8);
    o9 = fma(vec4f(w2.w), t5, o9);
    o10 = fma(vec4f(w2.z), t5, o10);
    o11 = fma(vec4f(w2.y), t5, o11);
    o12 = fma(vec4f(w2.x), t5, o12);
    o13 = fma(vec4f(w1.w), t5, o13);
    o14 = fma(vec4f(w1.z), t5, o14);
    o15 = fma(vec4f(w1.y), t5, o15);
    let t6 = filtering_value(textureLoad(map, clamp(first + 6 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.y), t6, o0);
    o1 = fma(vec4f(w5.x), t6, o1);
    o2 = fma(vec4f(w4.w), t6, o2);
    o3 = fma(vec4f(w4.z), t6, o3);
    o4 = fma(vec4f(w4.y), t6, o4);
    o5 = fma(vec4f(w4.x), t6, o5);
    o6 = fma(vec4f(w3.w), t6, o6);
    o7 = fma(vec4f(w3.z), t6, o7);
    o8 = fma(vec4f(w3.y), t6, o8);
    o9 = fma(vec4f(w3.x), t6, o9);
    o10 = fma(vec4f(w2.w), t6, o10);
    o11 = fma(vec4f(w2.z), t6, o11);
    o12 = fma(vec4f(w2.y), t6, o12);
    o13 = fma(vec4f(w2.x), t6, o13);
    o14 = fma(vec4f(w1.w), t6, o14);
    o15 = fma(vec4f(w1.z), t6, o15);
    let t7 = filtering_value(textureLoad(map, clamp(first + 7 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.z), t7, o0);
    o1 = fma(vec4f(w5.y), t7, o1);
    o2 = fma(vec4f(w5.x), t7, o2);
    o3 = fma(vec4f(w4.w), t7, o3);
    o4 = fma(vec4f(w4.z), t7, o4);
    o5 = fma(vec4f(w4.y), t7, o5);
    o6 = fma(vec4f(w4.x), t7, o6);
    o7 = fma(vec4f(w3.w), t7, o7);
    o8 = fma(vec4f(w3.z), t7, o8);
    o9 = fma(vec4f(w3.y), t7, o9);
    o10 = fma(vec4f(w3.x), t7, o10);
    o11 = fma(vec4f(w2.w), t7, o11);
    o12 = fma(vec4f(w2.z), t7, o12);
    o13 = fma(vec4f(w2.y), t7, o13);
    o14 = fma(vec4f(w2.x), t7, o14);
    o15 = fma(vec4f(w1.w), t7, o15);
    let t8 = filtering_value(textureLoad(map, clamp(first + 8 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.w), t8, o0);
    o1 = fma(vec4f(w5.z), t8, o1);
    o2 = fma(vec4f(w5.y), t8, o2);
    o3 = fma(vec4f(w5.x), t8, o3);
    o4 = fma(vec4f(w4.w), t8, o4);
    o5 = fma(vec4f(w4.z), t8, o5);
    o6 = fma(vec4f(w4.y), t8, o6);
    o7 = fma(vec4f(w4.x), t8, o7);
    o8 = fma(vec4f(w3.w), t8, o8);
    o9 = fma(vec4f(w3.z), t8, o9);
    o10 = fma(vec4f(w3.y), t8, o10);
    o11 = fma(vec4f(w3.x), t8, o11);
    o12 = fma(vec4f(w2.w), t8, o12);
    o13 = fma(vec4f(w2.z), t8, o13);
    o14 = fma(vec4f(w2.y), t8, o14);
    o15 = fma(vec4f(w2.x), t8, o15);
    let t9 = filtering_value(textureLoad(map, clamp(first + 9 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.x), t9, o0);
    o1 = fma(vec4f(w5.w), t9, o1);
    o2 = fma(vec4f(w5.z), t9, o2);
    o3 = fma(vec4f(w5.y), t9, o3);
    o4 = fma(vec4f(w5.x), t9, o4);
    o5 = fma(vec4f(w4.w), t9, o5);
    o6 = fma(vec4f(w4.z), t9, o6);
    o7 = fma(vec4f(w4.y), t9, o7);
    o8 = fma(vec4f(w4.x), t9, o8);
    o9 = fma(vec4f(w3.w), t9, o9);
    o10 = fma(vec4f(w3.z), t9, o10);
    o11 = fma(vec4f(w3.y), t9, o11);
    o12 = fma(vec4f(w3.x), t9, o12);
    o13 = fma(vec4f(w2.w), t9, o13);
    o14 = fma(vec4f(w2.z), t9, o14);
    o15 = fma(vec4f(w2.y), t9, o15);
    let t10 = filtering_value(textureLoad(map, clamp(first + 10 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.y), t10, o0);
    o1 = fma(vec4f(w6.x), t10, o1);
    o2 = fma(vec4f(w5.w), t10, o2);
    o3 = fma(vec4f(w5.z), t10, o3);
    o4 = fma(vec4f(w5.y), t10, o4);
    o5 = fma(vec4f(w5.x), t10, o5);
    o6 = fma(vec4f(w4.w), t10, o6);
    o7 = fma(vec4f(w4.z), t10, o7);
    o8 = fma(vec4f(w4.y), t10, o8);
    o9 = fma(vec4f(w4.x), t10, o9);
    o10 = fma(vec4f(w3.w), t10, o10);
    o11 = fma(vec4f(w3.z), t10, o11);
    o12 = fma(vec4f(w3.y), t10, o12);
    o13 = fma(vec4f(w3.x), t10, o13);
    o14 = fma(vec4f(w2.w), t10, o14);
    o15 = fma(vec4f(w2.z), t10, o15);
    let t11 = filtering_value(textureLoad(map, clamp(first + 11 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.z), t11, o0);
    o1 = fma(vec4f(w6.y), t11, o1);
    o2 = fma(vec4f(w6.x), t11, o2);
    o3 = fma(vec4f(w5.w), t11, o3);
    o4 = fma(vec4f(w5.z), t11, o4);
    o5 = fma(vec4f(w5.y), t11, o5);
    o6 = fma(vec4f(w5.x), t11, o6);
    o7 = fma(vec4f(w4.w), t11, o7);
    o8 = fma(vec4f(w4.z), t11, o8);
    o9 = fma(vec4f(w4.y), t11, o9);
    o10 = fma(vec4f(w4.x), t11, o10);
    o11 = fma(vec4f(w3.w), t11, o11);
    o12 = fma(vec4f(w3.z), t11, o12);
    o13 = fma(vec4f(w3.y), t11, o13);
    o14 = fma(vec4f(w3.x), t11, o14);
    o15 = fma(vec4f(w2.w), t11, o15);
    let t12 = filtering_value(textureLoad(map, clamp(first + 12 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.w), t12, o0);
    o1 = fma(vec4f(w6.z), t12, o1);
    o2 = fma(vec4f(w6.y), t12, o2);
    o3 = fma(vec4f(w6.x), t12, o3);
    o4 = fma(vec4f(w5.w), t12, o4);
    o5 = fma(vec4f(w5.z), t12, o5);
    o6 = fma(vec4f(w5.y), t12, o6);
    o7 = fma(vec4f(w5.x), t12, o7);
    o8 = fma(vec4f(w4.w), t12, o8);
    o9 = fma(vec4f(w4.z), t12, o9);
    o10 = fma(vec4f(w4.y), t12, o10);
    o11 = fma(vec4f(w4.x), t12, o11);
    o12 = fma(vec4f(w3.w), t12, o12);
    o13 = fma(vec4f(w3.z), t12, o13);
    o14 = fma(vec4f(w3.y), t12, o14);
    o15 = fma(vec4f(w3.x), t12, o15);
    let t13 = filtering_value(textureLoad(map, clamp(first + 13 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.x), t13, o0);
    o1 = fma(vec4f(w6.w), t13, o1);
    o2 = fma(vec4f(w6.z), t13, o2);
    o3 = fma(vec4f(w6.y), t13, o3);
    o4 = fma(vec4f(w6.x), t13, o4);
    o5 = fma(vec4f(w5.w), t13, o5);
    o6 = fma(vec4f(w5.z), t13, o6);
    o7 = fma(vec4f(w5.y), t13, o7);
    o8 = fma(vec4f(w5.x), t13, o8);
    o9 = fma(vec4f(w4.w), t13, o9);
    o10 = fma(vec4f(w4.z), t13, o10);
    o11 = fma(vec4f(w4.y), t13, o11);
    o12 = fma(vec4f(w4.x), t13, o12);
    o13 = fma(vec4f(w3.w), t13, o13);
    o14 = fma(vec4f(w3.z), t13, o14);
    o15 = fma(vec4f(w3.y), t13, o15);
    let t14 = filtering_value(textureLoad(map, clamp(first + 14 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.y), t14, o0);
    o1 = fma(vec4f(w7.x), t14, o1);
    o2 = fma(vec4f(w6.w), t14, o2);
    o3 = fma(vec4f(w6.z), t14, o3);
    o4 = fma(vec4f(w6.y), t14, o4);
    o5 = fma(vec4f(w6.x), t14, o5);
    o6 = fma(vec4f(w5.w), t14, o6);
    o7 = fma(vec4f(w5.z), t14, o7);
    o8 = fma(vec4f(w5.y), t14, o8);
    o9 = fma(vec4f(w5.x), t14, o9);
    o10 = fma(vec4f(w4.w), t14, o10);
    o11 = fma(vec4f(w4.z), t14, o11);
    o12 = fma(vec4f(w4.y), t14, o12);
    o13 = fma(vec4f(w4.x), t14, o13);
    o14 = fma(vec4f(w3.w), t14, o14);
    o15 = fma(vec4f(w3.z), t14, o15);
    let t15 = filtering_value(textureLoad(map, clamp(first + 15 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.z), t15, o0);
    o1 = fma(vec4f(w7.y), t15, o1);
    o2 = fma(vec4f(w7.x), t15, o2);
    o3 = fma(vec4f(w6.w), t15, o3);
    o4 = fma(vec4f(w6.z), t15, o4);
    o5 = fma(vec4f(w6.y), t15, o5);
    o6 = fma(vec4f(w6.x), t15, o6);
    o7 = fma(vec4f(w5.w), t15, o7);
    o8 = fma(vec4f(w5.z), t15, o8);
    o9 = fma(vec4f(w5.y), t15, o9);
    o10 = fma(vec4f(w5.x), t15, o10);
    o11 = fma(vec4f(w4.w), t15, o11);
    o12 = fma(vec4f(w4.z), t15, o12);
    o13 = fma(vec4f(w4.y), t15, o13);
    o14 = fma(vec4f(w4.x), t15, o14);
    o15 = fma(vec4f(w3.w), t15, o15);
    return BlurSums(o0, o1, o2, o3, o4, o5, o6, o7, o8, o9, o10, o11, o12, o13, o14, o15);
}
fn blur_outputs(sums: BlurSums) -> array<vec4f, 16> {
    return array<vec4f, 16>(sums.o0, sums.o1, sums.o2, sums.o3, sums.o4, sums.o5, sums.o6, sums.o7, sums.o8, sums.o9, sums.o10, sums.o11, sums.o12, sums.o13, sums.o14, sums.o15);
}

