// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// fullscreen: Covered fullscreen
// regions: regions region_at
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// map_texture: texel_of_texture
// blur_source: moments_map blur_size blur_source blur_stored
// moment_shadows/filter/separable.wgsl: separable_add
// written_texel: LEVEL written_size written_texel
// write_drawn.wgsl: RegionPixel region_of write_map

// specialization
const GROUP = 0;
alias MapTexture = texture_2d<f32>;
const STORAGE = 5u;
const REGIONS = 1u;
const AXIS = vec2i(1, 0);

// map_filtering
fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

// blur_texel
fn blur_texel(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    var sum = vec4f(0.0);
    sum = separable_add(sum, 0.16637802, blur_source(texel + -1 * AXIS, low, last, region), true);
    sum = separable_add(sum, 0.66724396, blur_source(texel + 0 * AXIS, low, last, region), true);
    sum = separable_add(sum, 0.16637802, blur_source(texel + 1 * AXIS, low, last, region), true);
    return sum;
}

