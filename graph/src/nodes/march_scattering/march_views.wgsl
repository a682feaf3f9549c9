import moment_shadows::air::height_fog::{HeightFog};
import moment_shadows::air::punctual_light::{PunctualLight};
import moment_shadows::air::single_scattering::{SingleScattering};
import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::shade::leak_reduction::{LeakReduction};
import node::specialization::{GROUP, VIEWS};

// The views of a light, and what is in its air. What is not of a view is the same for all, and the first one's counts.

struct MarchScatteringParameters {
    // By rows, the scene position relative to the camera, times its homogeneous coordinate.
    position_from_camera: mat3x4f,
    scene_w_from_camera: vec4f,
    medium: SingleScattering,
    fog: HeightFog,
    light: PunctualLight,
    // Of the view: from positions relative to the camera to its map. x and y are the place in [0, 1], z the homogeneous coordinate
    // that they are divided by, positive in front of the light, and w the moment depth.
    map_from_position: mat4x4f,
    leak_reduction: LeakReduction,
    // How its depth map stores depth: for tests on the plain depth map.
    conversion: DepthConversion,
    // Its place in its layer; a view without texels is unused.
    region: MapRegion,
    // The camera in the scene, and four numbers of the host's own: for its density.
    eye: vec3f,
    // The scene's homogeneous coordinate at the far end.
    farthest_w: f32,
    own: vec4f,
    // By how much steps are shifted in this frame, as a part of one.
    offset: f32,
    // Texels along the region's edges in which no place is looked up.
    guard: f32,
    layer: u32,
    padding: u32,
}

@group(GROUP) @binding(0) var<uniform> views: array<MarchScatteringParameters, VIEWS>;
