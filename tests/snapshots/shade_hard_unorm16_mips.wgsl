// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_last_level map_region_place
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial hankel_christoffel_number
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_BIAS_UNORM16 FOUR_MOMENTS_BIAS_FLOAT16 FOUR_MOMENTS_BIAS_FLOAT32 FOUR_MOMENTS_BIAS_PACKED64 FOUR_MOMENTS_BIAS_PACKED32 FOUR_MOMENTS_SQRT_3 four_moments_clamp four_moments_bias_of four_moments_apply_bias four_moments_biased_from_texel
// moment_shadows/bounds/hamburger4.wgsl: HAMBURGER4_FARTHEST_SUPPORT HAMBURGER4_SMALLEST_LEADING_COEFFICIENT Hamburger4Support hamburger4_support hamburger4_lower_bound_at hamburger4_lower_bound
// clamping.: hamburger4_shadow_intensity_of_texel
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationFootprint MinificationAxes minification_axes minification_footprint MINIFICATION_SLACK minification_probe minification_axes_gradients minification_axes_depth_variance
// moment_shadows/map/map_load.wgsl: map_load_between map_load_bilinear map_load_trilinear map_load_footprint
// moment_shadows/map/map_lookup.wgsl: map_lookup_gradient map_lookup_is_inner
// moments_lookup: moments_map anisotropic_sampler moments_lookup
// moment_shadows/map/depth.wgsl: DepthConversion
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
const STORAGE = 0u;
const PLANES = 1u;
const LEVELS = 4u;
const ANISOTROPY = 8.0;
const FITTED = false;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 1u;
const LIGHTS = 1u;
const TARGETS = 1u;

// technique
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return hamburger4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}

