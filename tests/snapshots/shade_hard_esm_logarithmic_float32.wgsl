// What is linked of files:
// fullscreen: Covered fullscreen
// moment_shadows/map/depth.wgsl: DepthConversion depth_is_nan depth_of_fragment
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_place
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationFootprint minification_footprint minification_depth_variance
// moment_shadows/shade/area_light.wgsl: AreaLight
// moment_shadows/shade/receiver_bias.wgsl: RECEIVER_BIAS_STANDARD_DEVIATIONS RECEIVER_BIAS_EDGE_ON ReceiverBias receiver_bias_plane receiver_bias_depth receiver_bias_depth_minified
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 storage_is_float storage_finite_texel
// moment_shadows/techniques/exponential.wgsl: EXPONENTIAL_LARGEST_EXPONENT EXPONENTIAL_SMALLEST_EXPONENT EXPONENTIAL_SMALLEST_MEAN exponential_exponent exponential_logarithm_of_texel exponential_mean_of_texel exponential_shadow_intensity
// moments_lookup: moments_map
// technique_receiver: TechniqueReceiver
// technique_map: technique_map_size
// shade.wgsl: ViewParameters views camera_depth Receiver receiver_at camera_depth_at extrapolation_error UNUSABLE LARGEST_DIFFERENCE neighbour_of receiver_difference view_shadow_intensity shade

// specialization
const GROUP = 0;
const LEVELS = 1u;
const VIEWS = 1u;
const LIGHTS = 1u;
const ANISOTROPY = 8.0;

const STORAGE = 2u;
const EXPONENT = f32(80.0);


// technique

// Texels hold logarithms: they are decoded before they are blended.

fn mean_at(texel: vec2i, layer: u32) -> f32 {
    return exponential_mean_of_texel(textureLoad(moments_map, texel, layer, 0), STORAGE, EXPONENT, true);
}

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let place = map_region_place(receiver.region, receiver.uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(receiver.region.origin + receiver.region.extent) - 1);
    let top = mix(mean_at(low, receiver.layer), mean_at(vec2i(high.x, low.y), receiver.layer), weight.x);
    let bottom = mix(mean_at(vec2i(low.x, high.y), receiver.layer), mean_at(high, receiver.layer), weight.x);
    return exponential_shadow_intensity(mix(top, bottom, weight.y), receiver.fragment_depth, EXPONENT, 0.0);
}

