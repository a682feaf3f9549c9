// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_last_level map_region_place
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/map/depth.wgsl: DepthConversion depth_is_nan depth_of_fragment
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 storage_is_float storage_finite_texel
// moment_shadows/moments/two_moments.wgsl: TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16 TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16 TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32 two_moments_from_texel two_moments_smallest_variance_of
// moment_shadows/bounds/chebyshev.wgsl: chebyshev_lower_bound
// moment_shadows/techniques/layered_variance.wgsl: LAYERED_VARIANCE_LARGEST_COUNT LAYERED_VARIANCE_SMALLEST_HALF_WIDTH LayeredVarianceLayers layered_variance_split layered_variance_count layered_variance_interval layered_variance_warp layered_variance_last_layer layered_variance_shadow_intensity_of_texel layered_variance_shadow_intensity_of_plane
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationFootprint MinificationAxes minification_axes minification_footprint MINIFICATION_SLACK minification_probe minification_axes_depth_variance
// moment_shadows/map/map_load.wgsl: map_load_between map_load_bilinear map_load_trilinear map_load_footprint
// moments_lookup: moments_map moments_lookup
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight area_light_fitted
// technique_receiver: TechniqueReceiver
// map_texel: map_texel
// technique_layers: technique_layers
// technique_map: technique_map_size
// view_list: ViewList view_list view_list_next
// moment_shadows/shade/receiver_bias.wgsl: RECEIVER_BIAS_STANDARD_DEVIATIONS RECEIVER_BIAS_EDGE_ON ReceiverBias RECEIVER_BIAS_ROUNDING receiver_bias_fitted receiver_bias_step receiver_bias_depth receiver_bias_depth_minified
// range_of_view: range_of_view
// views: ViewParameters VIEW_FADES VIEW_ROUND views Receiver receiver_at
// view_receiver: LARGEST_DIFFERENCE receiver_change ReceiverSlope receiver_slope SMALLEST_FACING receiver_difference view_receiver border_depth
// shade_pixel: BORDERS border_parts region_contains first_view shade_single shade_pixel
// shade_drawn.wgsl: shade

// specialization
const GROUP = 0;
const STORAGE = 2u;
const LAYERS = 4u;
const LAYER_OVERLAP = f32(0.02);
const LAYER_SPLITS_LOW = vec4f(-0.5, 0.0, 0.5, 1.0);
const LAYER_SPLITS_HIGH = vec4f(1.0, 1.0, 1.0, 1.0);
const PLANES = 2u;
const LEVELS = 1u;
const ANISOTROPY = 8.0;
const FITTED = false;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 1u;
const LIGHTS = 1u;
const TARGETS = 1u;

// technique
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let layers = technique_layers(receiver.layer);
    let last = layered_variance_last_layer(layers, receiver.fragment_depth);
    var intensity = 0.0;
    for (var plane = 0u; plane <= last / 2u; plane++) {
        let texel = map_texel(receiver, plane);
        intensity = max(intensity, layered_variance_shadow_intensity_of_plane(texel, receiver.fragment_depth, STORAGE, layers, plane));
    }
    return intensity;
}

