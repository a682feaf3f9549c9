// What is linked of files:
// map_texture: texel_to_texture
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 STORAGE_PACKED64 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels
// moment_shadows/moments/four_moments.wgsl: four_moments_filter_texel
// written_texel: LEVEL finer_level box_weights written_size written_texel
// write_computed.wgsl: written_map write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;

// map_filtering
// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return four_moments_filter_texel(value, STORAGE);
}

