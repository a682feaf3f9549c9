// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_SQRT_3 four_moments_dequantize four_moments_apply_bias
// moment_shadows/filter/summed_area_encoding.wgsl: SUMMED_AREA_ENCODING_BIAS_PER_ERROR SUMMED_AREA_ENCODING_BIAS_OF_F32 SUMMED_AREA_ENCODING_SMALLEST_BIAS summed_area_encoding_moment_bias
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight AREA_LIGHT_LARGEST_RADIUS AREA_LIGHT_BOX_OF_DISK area_light_fitted area_light_half_extent area_light_limited area_light_box
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial hankel_christoffel_number
// moment_shadows/bounds/hamburger4.wgsl: HAMBURGER4_FARTHEST_SUPPORT HAMBURGER4_SMALLEST_LEADING_COEFFICIENT Hamburger4Support hamburger4_support hamburger4_lower_bound_at hamburger4_lower_bound
// moment_shadows/shade/receiver_bias.wgsl: RECEIVER_BIAS_STANDARD_DEVIATIONS RECEIVER_BIAS_EDGE_ON ReceiverBias RECEIVER_BIAS_ROUNDING receiver_bias_fitted receiver_bias_step receiver_bias_depth receiver_bias_depth_minified receiver_bias_depth_of_kernel
// moment_shadows/shade/soft_blockers.wgsl: SoftBlockers SOFT_BLOCKERS_SMALLEST_SHARE soft_blockers_from soft_blockers_of_four_moments
// moment_shadows/filter/summed_area_table.wgsl: SummedAreaTableRectangle summed_area_table_rectangle SummedAreaTableOrigin summed_area_table_origin SummedAreaTableStrips summed_area_table_strips summed_area_table_row summed_area_table_mean_interpolated summed_area_table_mean_plain
// moment_shadows/map/depth.wgsl: DepthConversion
// moment_shadows/shade/moment_soft_shadows.wgsl: MOMENT_SOFT_SHADOWS_SMALLEST_EXTENT MomentSoftShadowTable MomentSoftShadowReceiver moment_soft_shadows_mean moment_soft_shadows_rectangle moment_soft_shadows_fragment_depth moment_soft_shadows_blockers moment_soft_shadows_intensity
// technique_map: table_sums technique_map_size
// technique_receiver: TechniqueReceiver
// technique_soft: soft_table soft_receiver
// view_list: ViewList view_list view_list_next
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationAxes minification_axes MINIFICATION_SLACK minification_axes_depth_variance
// range_of_view: range_of_view
// views: ViewParameters VIEW_FADES VIEW_ROUND views Receiver receiver_at
// view_receiver: LARGEST_DIFFERENCE receiver_change ReceiverSlope receiver_slope SMALLEST_FACING receiver_difference view_receiver border_depth
// shade_pixel: BORDERS border_parts region_contains first_view shade_single shade_pixel
// shade_drawn.wgsl: shade

// specialization
const GROUP = 0;
const LEVELS = 1u;
const ANISOTROPY = 1.0;
const LARGEST_KERNEL = vec2f(65.0, 65.0);
const TABLE_UNIT = f32(1016560u);
const TABLE_ERROR = f32(4.918549e-7);
const SEARCH_INTERPOLATED = false;
const FILTER_INTERPOLATED = true;
const FITTED = false;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 1u;
const LIGHTS = 1u;
const TARGETS = 1u;

// technique
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    return moment_soft_shadows_intensity(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);
}

