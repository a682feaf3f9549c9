// What is linked of files:
// fullscreen: Covered fullscreen
// moment_shadows/map/storage.wgsl: STORAGE_FLOAT16 STORAGE_FLOAT32 STORAGE_PACKED64 STORAGE_PACKED32
// moment_shadows/moments/four_moments.wgsl: FourMomentsBias FOUR_MOMENTS_BIAS_UNORM16 FOUR_MOMENTS_BIAS_FLOAT16 FOUR_MOMENTS_BIAS_FLOAT32 FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16 FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16 FOUR_MOMENTS_BIAS_PACKED64 FOUR_MOMENTS_BIAS_PACKED32 FOUR_MOMENTS_SQRT_3 four_moments_dequantize four_moments_from_texel four_moments_bias_of four_moments_bias_rounded_inwards_of four_moments_apply_bias
// debug_moments.wgsl: moments_level SHOW_MOMENTS SHOW_MEAN SHOW_DEVIATION NOT_FINITE EMPTY IMPOSSIBLE REPAIRED POSSIBLE is_not_finite possible moment_bias validity debug

// specialization
const GROUP = 0;
const STORAGE = 0u;
const ROUNDED_INWARDS = false;
const SHOW = 3u;

