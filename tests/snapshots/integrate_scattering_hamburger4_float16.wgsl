// What is linked of files:
// moment_shadows/maths/angle.wgsl: ANGLE_PI ANGLE_HALF_PI ANGLE_QUARTER_PI ANGLE_QUARTER_PI_REST ANGLE_TAN_EIGHTH_PI ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_atan2 angle_sin_cos
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame rectified_frame_ray
// moment_shadows/air/scattering_weights.wgsl: scattering_weights_clip scattering_weights_inclinations scattering_weights_reference_sine scattering_weights_thickness scattering_weights_of_column
// integrate_target: IntegrateScatteringParameters parameters rectified_map integrated_map row_thickness
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_UNORM10 STORAGE_PACKED64 storage_round_to_float16 storage_round_to_unorm10 storage_round_texel
// moment_shadows/moments/packed_four_moments.wgsl: PACKED_FOUR_MOMENTS_STEPS PACKED_FOUR_MOMENTS_LARGEST_DEPTH PACKED_FOUR_MOMENTS_LEAST_VARIANCE PACKED_FOUR_MOMENTS_LEAST_DISTANCE PackedFourMomentsNodes packed_four_moments_nodes packed_four_moments_channels
// moment_shadows/moments/four_moments.wgsl: four_moments_filter_texel
// row_sums: RowSums row_sums_texel row_sums_join row_sums_mean
// integrate_scattering_parallel.wgsl: THREADS TEXELS sums sums_of_texel integrate

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16float, write>;
const STORAGE = 1u;

// map_filtering
// The texel for such an average.
fn filtering_texel(value: vec4f) -> vec4f {
    return four_moments_filter_texel(value, STORAGE);
}

