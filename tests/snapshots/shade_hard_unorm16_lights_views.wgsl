// What is linked of files:
// camera_depth: camera_depth CameraPixel camera_depth_size camera_depth_pixel camera_depth_at camera_depth_clip
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within
// moments_lookup: moments_map
// technique_map: technique_map_size
// moment_shadows/map/depth.wgsl: DepthConversion
// moment_shadows/shade/area_light.wgsl: AreaLight
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction
// moment_shadows/shade/receiver_bias.wgsl: ReceiverBias
// views: ViewParameters views
// find_views.wgsl: found_views FIRST_VIEW least most found ROUNDING may_contain find_views

// specialization
const GROUP = 0;
alias CameraDepth = texture_depth_2d;
const CAMERA_SAMPLE = vec2f(0.5, 0.5);
const VIEWS = 16u;
const TILE = 16;

