// What is linked of files:
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel_around camera_depth_at camera_depth_clip
// fullscreen: Covered fullscreen
// moments_lookup: moments_map moments_sampler
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial hankel_christoffel_number
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_BIAS_UNORM16 FOUR_MOMENTS_BIAS_FLOAT16 FOUR_MOMENTS_BIAS_FLOAT32 FOUR_MOMENTS_BIAS_PACKED64 FOUR_MOMENTS_BIAS_PACKED32 FOUR_MOMENTS_SQRT_3 four_moments_clamp four_moments_bias_of four_moments_apply_bias four_moments_biased_from_texel
// moment_shadows/bounds/hamburger4.wgsl: HAMBURGER4_FARTHEST_SUPPORT HAMBURGER4_SMALLEST_LEADING_COEFFICIENT Hamburger4Support hamburger4_support hamburger4_bounds_at hamburger4_bounds
// scattering_lookup: scattering_lookup
// scattering_bounds: scattering_bounds
// moment_shadows/maths/angle.wgsl: ANGLE_PI angle_of_small_tangent
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame RectifiedFrameRay rectified_frame_view_ray rectified_frame_place rectified_frame_depth rectified_frame_direction rectified_frame_w rectified_frame_row rectified_frame_prefix
// scattering_ray: ScatteringRay scattering_ray_of
// moment_shadows/air/phase_function.wgsl: PHASE_FUNCTION_ISOTROPIC PHASE_FUNCTION_LARGEST_ANISOTROPY phase_function_henyey_greenstein
// moment_shadows/air/single_scattering.wgsl: SINGLE_SCATTERING_LOG2_E SingleScattering single_scattering_mean_of_halves SINGLE_SCATTERING_LARGEST SingleScatteringRay single_scattering_ray single_scattering_pixel single_scattering_shadow
// composite_scattering.wgsl: CompositeScatteringParameters parameters composite

// specialization
const GROUP = 0;
const STORAGE = 1u;
const OVERESTIMATION = vec2f(0.2, 0.35);
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);

