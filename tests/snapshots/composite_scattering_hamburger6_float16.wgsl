// What is linked of files:
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel_around camera_depth_at camera_depth_clip
// fullscreen: Covered fullscreen
// moments_lookup: moments_map moments_sampler
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_UNORM10 storage_is_float
// moment_shadows/moments/six_moments.wgsl: SixMoments SixMomentsBias SIX_MOMENTS_BIAS_TARGET SIX_MOMENTS_BIAS_UNORM16 SIX_MOMENTS_BIAS_FLOAT16 SIX_MOMENTS_BIAS_FLOAT32 SIX_MOMENTS_BIAS_UNORM10 SIX_MOMENTS_ODD_OFFSET SIX_MOMENTS_EVEN_OFFSET SIX_MOMENTS_ODD_INVERSE SIX_MOMENTS_EVEN_INVERSE six_moments_affine six_moments_middle six_moments_from_channels six_moments_bias_of six_moments_apply_bias six_moments_biased_from_channels
// moment_shadows/bounds/hamburger6.wgsl: Hamburger6Factor Hamburger6Polynomials HAMBURGER6_SMALLEST_PIVOT HAMBURGER6_LARGEST_SHIFT HAMBURGER6_LARGEST_RATIO HAMBURGER6_FARTHEST_SUPPORT HAMBURGER6_STEPS HAMBURGER6_LARGE_ALPHA HAMBURGER6_STEPS_OF_LARGE_ALPHA hamburger6_factor hamburger6_polynomials hamburger6_negative_root hamburger6_lone_weight hamburger6_bounds_at
// moment_shadows/moments/enclosed_moments.wgsl:
// them.: ENCLOSED_MOMENTS_SMALLEST_WEIGHT ENCLOSED_MOMENTS_LARGEST_ALPHA enclosed_moments_bias enclosed_moments_biased enclosed_moments_are_finite enclosed_moments_bounds
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

