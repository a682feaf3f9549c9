// What is linked of files:
// moment_shadows/maths/angle.wgsl: ANGLE_HALF_PI_FIRST ANGLE_HALF_PI_SECOND ANGLE_HALF_PI_THIRD ANGLE_LARGEST angle_finite angle_sin_cos
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame rectified_frame_inclination
// moment_shadows/map/map_region.wgsl: MapRegion
// rectify_parameters: RectifyMomentsParameters parameters
// moment_shadows/air/view_rays.wgsl: view_rays_depths VIEW_RAYS_ROWS VIEW_RAYS_STEPS view_rays_texel
// bound_rays.wgsl: view_ray_codes view_rays_map THREADS maxima codes_of codes_about bound_rays

// specialization
const GROUP = 0;
const EXTENT = vec2u(1024u, 1024u);

