// What is linked of files:
// map_texture: texel_to_texture
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/maths/angle.wgsl: ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_sin_cos
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 storage_is_float storage_round_to_float16
// moment_shadows/techniques/convolution.wgsl: CONVOLUTION_LARGEST_TERMS CONVOLUTION_BOUNDS convolution_terms convolution_bound convolution_place convolution_waves convolution_channels convolution_to_texel
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth range_fit_map_depth
// range_of_region: range_of_region
// resolved: conversions depth_map resolved_size resolved_channels
// written_texel: LEVEL written_size written_texel
// write_computed.wgsl: written_map write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba8unorm, write>;
const TERMS = 8u;
const STORAGE = 3u;
const FITTED = false;
alias DepthTexture = texture_depth_multisampled_2d;
const REGIONS = 1u;
const SAMPLES = 4;

// map_encoding
override PLANE: u32;

// What is averaged for a moment depth.
fn encoding_channels(z: f32) -> vec4f {
    return convolution_channels(z, PLANE, TERMS);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return convolution_to_texel(mean, STORAGE);
}

