// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_place
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/maths/angle.wgsl: ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_sin_cos
// moment_shadows/map/depth.wgsl: DepthConversion depth_is_nan depth_of_fragment
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 storage_is_float storage_finite_texel
// moment_shadows/techniques/convolution.wgsl: CONVOLUTION_LARGEST_TERMS CONVOLUTION_DAMPING CONVOLUTION_BOUNDS convolution_terms convolution_bound convolution_place convolution_waves convolution_receiver convolution_plane convolution_shadow_intensity
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationAxes minification_axes MINIFICATION_SLACK minification_axes_depth_variance
// moment_shadows/map/map_lookup.wgsl: map_lookup_bilinear
// moments_lookup: moments_map moments_sampler moments_lookup
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight area_light_fitted
// technique_receiver: TechniqueReceiver
// map_texel: map_texel
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
const STORAGE = 3u;
const TERMS = 8u;
const LOWER_BOUND = true;
const PLANES = 4u;
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
    let place = convolution_receiver(receiver.fragment_depth, TERMS, LOWER_BOUND);
    var sum = 0.0;
    for (var plane = 0u; plane < PLANES; plane++) {
        sum += convolution_plane(map_texel(receiver, plane), STORAGE, plane, TERMS, place, CONVOLUTION_DAMPING);
    }
    return convolution_shadow_intensity(sum, TERMS, LOWER_BOUND);
}

