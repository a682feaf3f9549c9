// What is linked of files:
// moment_shadows/air/phase_function.wgsl: PHASE_FUNCTION_ISOTROPIC PHASE_FUNCTION_LARGEST_ANISOTROPY phase_function_henyey_greenstein
// moment_shadows/air/single_scattering.wgsl: SINGLE_SCATTERING_LOG2_E SingleScattering single_scattering_mean_of_halves single_scattering_mean_transmittance SINGLE_SCATTERING_LARGEST SingleScatteringRay single_scattering_pixel
// moment_shadows/air/height_fog.wgsl: HeightFog HEIGHT_FOG_THINNEST HEIGHT_FOG_DENSEST HEIGHT_FOG_THICKEST
// occurs.: height_fog_valid height_fog_thickness
// moment_shadows/air/punctual_light.wgsl: PunctualLight PUNCTUAL_LIGHT_FARTHEST punctual_light_at punctual_light_cone PUNCTUAL_LIGHT_CONE_SLACK punctual_light_interval
// moment_shadows/maths/angle.wgsl: ANGLE_PI ANGLE_HALF_PI ANGLE_QUARTER_PI ANGLE_QUARTER_PI_REST ANGLE_TAN_EIGHTH_PI ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_atan2 angle_sin_cos
// moment_shadows/air/march.wgsl: MarchSteps march_steps march_place march_falloff March march_begin march_thickness march_transmittance march_step
// moment_shadows/air/view_ray.wgsl: VIEW_RAY_LONGEST ViewRay view_ray_of_pixel
// moment_shadows/maths/blue_noise.wgsl: BLUE_NOISE_TILE blue_noise_offset
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/depth.wgsl: DepthConversion DEPTH_SMALLEST_DENOMINATOR DEPTH_INFINITELY_FAR depth_is_nan depth_to_moment_depth depth_of_light
// march_views: MarchScatteringParameters views
// range_of_view: range_of_view
// moment_shadows/shade/receiver_plane.wgsl: ReceiverPlane RECEIVER_PLANE_LARGEST receiver_plane_through receiver_plane_depth
// moment_shadows/techniques/percentage_closer.wgsl: percentage_closer_texel percentage_closer_map_depth percentage_closer_plane_depth percentage_closer_tap percentage_closer_binary
// technique_map: depth_map technique_map_size
// technique_receiver: TechniqueReceiver
// air_shadow: LARGEST_DIFFERENCE ViewShadow view_shadow air_shadow
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_at camera_depth_clip
// density: density
// fullscreen: Covered fullscreen
// march_scattering.wgsl: stretch_thickness march

// specialization
const GROUP = 0;
const LEVELS = 1u;
const FITTED = false;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 1u;
const STEPS = 16u;
const PER_TEXEL = 1u;
const DITHERED = true;
const OWN_DENSITY = false;

// technique
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, depth_of_light(receiver.conversion));
    return percentage_closer_binary(depth_map, receiver.layer, receiver.region, plane, receiver.conversion);
}

