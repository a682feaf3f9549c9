// What is linked of files:
// map_texture: texel_to_texture
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// regions: regions region_at RegionTile region_tile
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 storage_round_to_float16
// moment_shadows/moments/two_moments.wgsl: two_moments_to_texel
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR depth_is_nan depth_to_moment_depth
// moment_shadows/techniques/layered_variance.wgsl: LAYERED_VARIANCE_LARGEST_COUNT LAYERED_VARIANCE_SMALLEST_HALF_WIDTH LayeredVarianceLayers layered_variance_split layered_variance_count layered_variance_interval layered_variance_warp layered_variance_channels
// technique_layers: technique_layers
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth range_fit_map_depth
// range_of_region: range_of_region
// resolved: conversions depth_map resolved_size resolved_channels
// written_texel: LEVEL written_size written_texel
// write_computed.wgsl: written_map write_map

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba32float, write>;
const LAYERS = 4u;
const LAYER_OVERLAP = f32(0.02);
const LAYER_SPLITS_LOW = vec4f(-0.5, 0.0, 0.5, 1.0);
const LAYER_SPLITS_HIGH = vec4f(1.0, 1.0, 1.0, 1.0);
const STORAGE = 2u;
const FITTED = false;
alias DepthTexture = texture_depth_multisampled_2d;
const REGIONS = 1u;
const SAMPLES = 4;

// map_encoding
override PLANE: u32;

// What is averaged for a moment depth.
fn encoding_channels(z: f32) -> vec4f {
    return layered_variance_channels(z, technique_layers(0u), PLANE);
}

// The texel for the mean.
fn encoding_texel(mean: vec4f) -> vec4f {
    return two_moments_to_texel(mean, STORAGE);
}

