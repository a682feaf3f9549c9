import moment_shadows::air::rectified_frame::{RectifiedFrame};
import moment_shadows::map::map_region::{MapRegion};
import node::specialization::{GROUP};

// What all passes know.

struct RectifyMomentsParameters {
    frame: RectifiedFrame,
    // Where the light ray through the camera meets the light's map, from 0 to 1 across the region, and by how much that
    // changes along the frame's first and second axis per scene unit.
    map_at_camera: vec2f,
    map_along_first: vec2f,
    map_along_second: vec2f,
    // The light's moment depth at the camera, and by how much it grows along the light per scene unit.
    depth_at_camera: f32,
    depth_per_length: f32,
    // Where the light's view lies in its map.
    region: MapRegion,
    layer: u32,
}

@group(GROUP) @binding(0) var<uniform> parameters: RectifyMomentsParameters;
