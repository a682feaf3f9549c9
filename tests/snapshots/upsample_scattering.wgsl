// What is linked of files:
// moment_shadows/air/upsample.wgsl: UPSAMPLE_SIMILAR UPSAMPLE_LEAST upsample_weight
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_pixel_around camera_depth_at camera_depth_clip
// fullscreen: Covered fullscreen
// upsample_scattering.wgsl: UpsampleScatteringParameters parameters scattering per_distance upsample

// specialization
const GROUP = 0;
const PER_TEXEL = 2u;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);

