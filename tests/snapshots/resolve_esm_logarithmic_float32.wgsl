// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_LARGEST_FLOAT16 storage_is_float storage_round_to_float16
// moment_shadows/techniques/exponential.wgsl: EXPONENTIAL_LARGEST_EXPONENT EXPONENTIAL_SMALLEST_EXPONENT EXPONENTIAL_SMALLEST_MEAN exponential_exponent exponential_channels exponential_to_texel
// resolve_texel: conversions depth_map resolve_texel
// resolve.wgsl: moments_map resolve

// specialization
const GROUP = 0;
alias DepthTexture = texture_depth_multisampled_2d;
const SAMPLES = 4;
alias MomentsStorage = texture_storage_2d<r32float, write>;
const STORAGE = 2u;
const EXPONENT = f32(80.0);
const LOGARITHMIC = true;
const REGIONS = 1u;

// map_encoding
fn encoding_channels(z: f32) -> vec4f {
    return exponential_channels(z, EXPONENT);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return exponential_to_texel(mean, STORAGE, EXPONENT, LOGARITHMIC);
}

