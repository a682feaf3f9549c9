// What is linked of files:
// camera_depth: camera_depth camera_depth_size camera_depth_at
// moment_shadows/map/depth.wgsl: DepthConversion
// moment_shadows/map/map_region.wgsl: MapRegion
// moment_shadows/shade/area_light.wgsl: AreaLight
// moment_shadows/shade/leak_reduction.wgsl: LeakReduction
// moment_shadows/shade/receiver_bias.wgsl: ReceiverBias
// views: ViewParameters views
// see_tiles.wgsl: target_map least most see_tiles

// specialization
const GROUP = 0;
alias CameraDepth = texture_depth_2d;
const VIEWS = 1u;
const SEEN_TILE = 8u;

