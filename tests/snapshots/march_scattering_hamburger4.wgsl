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
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_place
// moment_shadows/map/range_fit.wgsl: RangeFit range_fit_none range_fit_depth
// moment_shadows/shade/area_light.wgsl: AreaLight
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction leak_reduction_full_shadow LEAK_REDUCTION_LEAST_SHADOW leak_reduction_apply
// moment_shadows/map/depth.wgsl: DepthConversion
// march_views: MarchScatteringParameters views
// range_of_view: range_of_view
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial hankel_christoffel_number
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_BIAS_UNORM16 FOUR_MOMENTS_BIAS_FLOAT16 FOUR_MOMENTS_BIAS_FLOAT32 FOUR_MOMENTS_BIAS_PACKED64 FOUR_MOMENTS_BIAS_PACKED32 FOUR_MOMENTS_SQRT_3 four_moments_clamp four_moments_bias_of four_moments_apply_bias four_moments_biased_from_texel
// moment_shadows/bounds/hamburger4.wgsl: HAMBURGER4_FARTHEST_SUPPORT HAMBURGER4_SMALLEST_LEADING_COEFFICIENT Hamburger4Support hamburger4_support hamburger4_lower_bound_at hamburger4_lower_bound
// clamping.: hamburger4_shadow_intensity_of_texel
// moment_shadows/map/map_lookup.wgsl: map_lookup_bilinear
// moments_lookup: moments_map moments_sampler moments_lookup
// technique_receiver: TechniqueReceiver
// map_texel: map_texel
// technique_map: technique_map_size
// air_shadow: LARGEST_DIFFERENCE ViewShadow view_shadow air_shadow
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_at camera_depth_clip
// density: density
// fullscreen: Covered fullscreen
// march_scattering.wgsl: stretch_thickness march

// specialization
const GROUP = 0;
const STORAGE = 1u;
const PLANES = 1u;
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
    return hamburger4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}

