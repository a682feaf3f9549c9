// What is linked of files:
// map_texture: texel_to_texture
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32 storage_round_to_float16
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels
// moment_shadows/moments/four_moments.wgsl: FOUR_MOMENTS_SQRT_3 four_moments_from_depth four_moments_quantize four_moments_to_texel
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth range_fit_map_depth
// range_of_region: range_of_region
// resolved: conversions depth_map resolved_size resolved_channels
// written_texel: LEVEL written_size written_texel
// write_computed.wgsl: written_map write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const FITTED = false;
alias DepthTexture = texture_depth_multisampled_2d;
const REGIONS = 1u;
const SAMPLES = 4;

// map_encoding
fn encoding_channels(z: f32) -> vec4f {
    return four_moments_from_depth(z);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
}

