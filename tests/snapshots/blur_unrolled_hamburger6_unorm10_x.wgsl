// What is linked of files:
// moment_shadows/filter/separable.wgsl: separable_add
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// blur_source: blur_source
// fullscreen: Covered fullscreen
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_pixel: regions RegionPixel region_pixel
// blur_drawn.wgsl: moments_map blur

// specialization
const GROUP = 0;
const AXIS = vec2i(1, 0);
const STORAGE = 5u;
const REGIONS = 1u;

// map_filtering
fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

// blur_texel
fn blur_texel(map: texture_2d<f32>, texel: vec2i, low: vec2i, last: vec2i) -> vec4f {
    var sum = vec4f(0.0);
    sum = separable_add(sum, 0.16637802, blur_source(map, texel + -1 * AXIS, low, last), true);
    sum = separable_add(sum, 0.66724396, blur_source(map, texel + 0 * AXIS, low, last), true);
    sum = separable_add(sum, 0.16637802, blur_source(map, texel + 1 * AXIS, low, last), true);
    return sum;
}

