// What is linked of files:
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_at camera_depth_clip
// fullscreen: Covered fullscreen
// moment_shadows/map/map_region.wgsl: MapRegion map_region_at_level map_region_place
// moment_shadows/map/map_lookup.wgsl: map_lookup_bilinear
// moments_lookup: moments_map moments_sampler moments_lookup
// moment_shadows/maths/angle.wgsl: ANGLE_PI ANGLE_PI_REST ANGLE_HALF_PI ANGLE_HALF_PI_REST ANGLE_QUARTER_PI ANGLE_QUARTER_PI_REST ANGLE_TAN_EIGHTH_PI angle_finite angle_atan2
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame rectified_frame_component
// 0.: rectified_frame_coordinates rectified_frame_place rectified_frame_depth
// coordinates.: rectified_frame_surface rectified_frame_row rectified_frame_prefix
// moment_shadows/maths/hankel.wgsl: HankelFactor HANKEL_SMALLEST_VARIANCE HANKEL_SMALLEST_RESIDUE hankel_factor hankel_second_polynomial
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_UNORM10 storage_is_float storage_finite_texel
// moment_shadows/moments/six_moments.wgsl: SixMoments SixMomentsBias SIX_MOMENTS_BIAS_TARGET SIX_MOMENTS_BIAS_UNORM16 SIX_MOMENTS_BIAS_FLOAT16 SIX_MOMENTS_BIAS_FLOAT32 SIX_MOMENTS_BIAS_UNORM10 SIX_MOMENTS_ODD_OFFSET SIX_MOMENTS_EVEN_OFFSET SIX_MOMENTS_ODD_INVERSE SIX_MOMENTS_EVEN_INVERSE six_moments_affine six_moments_middle six_moments_bias_of six_moments_apply_bias
// moment_shadows/bounds/hamburger6.wgsl: Hamburger6Factor Hamburger6Polynomials HAMBURGER6_SMALLEST_PIVOT HAMBURGER6_LARGEST_SHIFT HAMBURGER6_LARGEST_RATIO HAMBURGER6_FARTHEST_SUPPORT HAMBURGER6_STEPS HAMBURGER6_LARGE_ALPHA HAMBURGER6_STEPS_OF_LARGE_ALPHA hamburger6_factor hamburger6_polynomials hamburger6_nodes_below hamburger6_lone_weight hamburger6_bounds
// moment_shadows/moments/enclosed_moments.wgsl:
// them.: ENCLOSED_MOMENTS_SMALLEST_WEIGHT ENCLOSED_MOMENTS_LARGEST_ALPHA enclosed_moments_means enclosed_moments_bias enclosed_moments_bounds
// scattering_bounds: scattering_bounds
// moment_shadows/air/phase_function.wgsl: PHASE_FUNCTION_ISOTROPIC PHASE_FUNCTION_LARGEST_ANISOTROPY phase_function_henyey_greenstein
// moment_shadows/air/single_scattering.wgsl: SingleScattering single_scattering_mean_transmittance SINGLE_SCATTERING_LARGEST single_scattering_transmittance single_scattering_radiance single_scattering_pixel
// occluders.: SINGLE_SCATTERING_DEPTH_BIAS single_scattering_fragment_depth single_scattering_shadow
// composite_scattering.wgsl: CompositeScatteringParameters parameters composite

// specialization
const GROUP = 0;
const STORAGE = 1u;
const OVERESTIMATION = vec2f(0.2, 0.35);
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);

