// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// fullscreen: Covered fullscreen
// regions: regions region_at
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// written_texel: LEVEL finer_level box_weights written_size written_texel
// write_drawn.wgsl: RegionPixel region_of write_map

// specialization
const GROUP = 0;
const STORAGE = 5u;
const REGIONS = 1u;

// map_filtering
// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

