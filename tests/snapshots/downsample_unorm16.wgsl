// What is linked of files:
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// downsample_texel: finer_level box_weights downsample_texel
// region_tile: regions RegionTile region_tile
// downsample.wgsl: LEVEL coarser_level downsample

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;

// map_filtering
// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

