// What is linked of files:
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_at camera_depth_clip
// moment_shadows/maths/angle.wgsl: ANGLE_PI angle_of_small_tangent
// moment_shadows/air/rectified_frame.wgsl: RectifiedFrame RectifiedFrameRay rectified_frame_view_ray rectified_frame_place rectified_frame_depth rectified_frame_direction rectified_frame_w
// moment_shadows/map/map_region.wgsl: MapRegion
// rectify_parameters: RectifyMomentsParameters parameters
// scattering_ray: ScatteringRay scattering_ray_of
// moment_shadows/air/view_rays.wgsl: view_rays_column view_rays_codes
// find_ends.wgsl: view_ray_codes find_ends

// specialization
const GROUP = 0;
const EXTENT = vec2u(1024u, 1024u);
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);

