import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_ray};
import moment_shadows::air::scattering_weights::{scattering_weights_thickness};
import node::specialization::{GROUP, MomentsStorage};

// What both ways to sum up rows share.

struct IntegrateScatteringParameters {
    frame: RectifiedFrame,
    // Per scene unit; at least 0.
    extinction: f32,
}

@group(GROUP) @binding(0) var<uniform> parameters: IntegrateScatteringParameters;
@group(GROUP) @binding(1) var rectified_map: texture_2d<f32>;
@group(GROUP) @binding(2) var integrated_map: MomentsStorage;

// The optical thickness of a column of a row.
fn row_thickness(row: u32) -> f32 {
    let size = textureDimensions(rectified_map);
    let place = f32(row) / f32(max(size.y, 2u) - 1u);
    let azimuth = rectified_frame_ray(parameters.frame, vec2f(0.0, place)).y;
    return scattering_weights_thickness(parameters.frame, azimuth, parameters.extinction, f32(size.x));
}
