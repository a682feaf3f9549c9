// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_last_level map_region_place
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_UNORM10 storage_is_float
// moment_shadows/moments/six_moments.wgsl: SixMoments SixMomentsBias SIX_MOMENTS_BIAS_TARGET SIX_MOMENTS_BIAS_UNORM16 SIX_MOMENTS_BIAS_FLOAT16 SIX_MOMENTS_BIAS_FLOAT32 SIX_MOMENTS_BIAS_UNORM10 SIX_MOMENTS_ODD_OFFSET SIX_MOMENTS_EVEN_OFFSET SIX_MOMENTS_ODD_INVERSE SIX_MOMENTS_EVEN_INVERSE six_moments_affine six_moments_middle six_moments_channels_of six_moments_from_channels six_moments_from_texels six_moments_bias_of six_moments_apply_bias six_moments_biased_from_channels six_moments_biased_from_texels
// moment_shadows/bounds/hamburger6.wgsl: Hamburger6Factor Hamburger6Polynomials HAMBURGER6_SMALLEST_PIVOT HAMBURGER6_LARGEST_SHIFT HAMBURGER6_LARGEST_RATIO HAMBURGER6_FARTHEST_SUPPORT HAMBURGER6_STEPS HAMBURGER6_LARGE_ALPHA HAMBURGER6_STEPS_OF_LARGE_ALPHA hamburger6_factor hamburger6_polynomials hamburger6_negative_root hamburger6_lone_weight hamburger6_bounds_at hamburger6_bounds hamburger6_lower_bound
// storage.: hamburger6_shadow_intensity_of_texels
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationFootprint MinificationAxes minification_axes minification_footprint MINIFICATION_SLACK minification_probe minification_axes_depth_variance
// moment_shadows/map/map_load.wgsl: map_load_between map_load_bilinear map_load_trilinear map_load_footprint
// moments_lookup: moments_map moments_lookup
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
const STORAGE = 2u;
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
    let texels = array<vec4f, 2>(map_texel(receiver, 0u), map_texel(receiver, 1u));
    return hamburger6_shadow_intensity_of_texels(texels, receiver.fragment_depth, STORAGE);
}

