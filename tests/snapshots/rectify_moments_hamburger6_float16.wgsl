// What is linked of files:
// moment_shadows/maths/angle.wgsl: ANGLE_PI ANGLE_HALF_PI ANGLE_QUARTER_PI ANGLE_QUARTER_PI_REST ANGLE_TAN_EIGHTH_PI ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_atan2 angle_sin_cos
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level map_region_place
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32 storage_is_float storage_round_to_float16 storage_finite_texel
// moment_shadows/moments/four_moments.wgsl: FOUR_MOMENTS_SQRT_3 four_moments_dequantize four_moments_from_texel
// moment_shadows/map/map_lookup.wgsl: map_lookup_bilinear
// moments_lookup: moments_map moments_sampler moments_lookup
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame rectified_frame_ray rectified_frame_depth
// occluders_shares: Occluders
// moment_shadows/air/single_scattering.wgsl: SINGLE_SCATTERING_DEPTH_BIAS
// shadow.: single_scattering_occluder_depth
// occluders: shares_of occluders_of
// moment_shadows/moments/six_moments.wgsl: SixMoments SIX_MOMENTS_ODD_BASIS SIX_MOMENTS_EVEN_BASIS SIX_MOMENTS_ODD_OFFSET SIX_MOMENTS_EVEN_OFFSET six_moments_affine six_moments_from_depth six_moments_middle
// moment_shadows/moments/enclosed_moments.wgsl: EnclosedMoments enclosed_moments_of_occluder enclosed_moments_sum enclosed_moments_texel enclosed_moments_to_odd_texel enclosed_moments_to_even_texel
// rectified_texel: rectified_map rectified_even rectified_store
// rectify_parameters: RectifyMomentsParameters parameters
// moment_shadows/maths/two_diracs.wgsl: TwoDiracs
// much.: TWO_DIRACS_SMALLEST_VARIANCE two_diracs_of_moments
// rectify_moments.wgsl: FAR_END rectified rectify

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16float, write>;
const STORAGE = 1u;
const SOURCE_STORAGE = 1u;

