// What is linked of files:
// camera_depth: camera_depth camera_sampler CameraPixel CameraSurface Neighbours camera_depth_size camera_depth_pixel camera_depth_pixel_around camera_depth_at camera_depth_clip
// fullscreen: Covered fullscreen
// intensity: intensity intensity_at
// moment_shadows/shade/contact_shadow.wgsl: ContactShadowParameters ContactShadowRay CONTACT_SHADOW_NEAREST CONTACT_SHADOW_FADE CONTACT_SHADOW_DEPTH_STEPS CONTACT_SHADOW_BIAS contact_shadow_ray contact_shadow_place contact_shadow_nearer contact_shadow_hides contact_shadow_intensity
// neighbours: stored_at gathered neighbours_at
// surface: UNUSABLE surface_at
// contact_shadows.wgsl: lights march contact

// specialization
const GROUP = 0;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const DEPTH_STEP = 5.960464477539063e-8;
const LIGHTS = 1u;
const STEPS = 16u;

