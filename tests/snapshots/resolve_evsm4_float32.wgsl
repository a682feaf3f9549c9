// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_LARGEST_FLOAT16 storage_round_to_float16
// moment_shadows/techniques/exponential_variance.wgsl: EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32 exponential_variance_warp exponential_variance_channels exponential_variance_to_texel
// resolve_texel: conversions depth_map resolve_texel
// resolve.wgsl: moments_map resolve

// specialization
const GROUP = 0;
alias DepthTexture = texture_depth_multisampled_2d;
const SAMPLES = 4;
alias MomentsStorage = texture_storage_2d<rgba32float, write>;
const STORAGE = 2u;
const EXPONENTS = vec2f(40.0, 5.0);
const REGIONS = 1u;

// map_encoding
fn encoding_channels(z: f32) -> vec4f {
    return exponential_variance_channels(z, EXPONENTS);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return exponential_variance_to_texel(mean, STORAGE);
}

