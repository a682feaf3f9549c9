// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel_around camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within
// moment_shadows/shade/view_border.wgsl: view_border_depth view_border_parts
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR DEPTH_INFINITELY_FAR depth_is_nan depth_to_moment_depth depth_of_light
// moment_shadows/shade/receiver_plane.wgsl: ReceiverPlane RECEIVER_PLANE_LARGEST receiver_plane_through receiver_plane_depth
// moment_shadows/techniques/percentage_closer.wgsl: percentage_closer_texel percentage_closer_map_depth percentage_closer_plane_depth percentage_closer_tap percentage_closer_binary
// technique_map: depth_map technique_map_size
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight area_light_fitted
// technique_receiver: TechniqueReceiver
// view_list: ViewList view_list view_list_next
// moment_shadows/map/minification.wgsl: MINIFICATION_LARGEST_ANISOTROPY MINIFICATION_TEXEL_PER_WIDTH MinificationAxes minification_axes MINIFICATION_SLACK minification_axes_depth_variance
// moment_shadows/shade/receiver_bias.wgsl: RECEIVER_BIAS_STANDARD_DEVIATIONS RECEIVER_BIAS_EDGE_ON ReceiverBias RECEIVER_BIAS_ROUNDING receiver_bias_fitted receiver_bias_step receiver_bias_depth receiver_bias_depth_minified
// range_of_view: range_of_view
// views: ViewParameters VIEW_FADES VIEW_ROUND views Receiver receiver_at
// view_receiver: LARGEST_DIFFERENCE receiver_change ReceiverSlope receiver_slope SMALLEST_FACING receiver_difference view_receiver border_depth
// shade_pixel: BORDERS border_parts region_contains first_view shade_single shade_pixel
// shade_drawn.wgsl: shade

// specialization
const GROUP = 0;
const LEVELS = 1u;
const ANISOTROPY = 1.0;
const FITTED = false;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 1u;
const LIGHTS = 1u;
const TARGETS = 1u;

// technique
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, depth_of_light(receiver.conversion));
    return percentage_closer_binary(depth_map, receiver.layer, receiver.region, plane, receiver.conversion);
}

