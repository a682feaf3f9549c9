import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_coordinates, rectified_frame_depth, rectified_frame_place, rectified_frame_ray, rectified_frame_surface};
import moment_shadows::maths::angle::{angle_sin_cos};

struct BatchInput {
    frame: RectifiedFrame,
    device: vec2f,
    stored_depth: f32,
    padding: f32,
}

struct BatchOutput {
    position: vec3f,
    depth: f32,
    coordinates: vec3f,
    // The inclination of that depth.
    inclination: f32,
    // There and back again, twice.
    back: vec3f,
    padding: f32,
    again: vec3f,
    more_padding: f32,
    place: vec2f,
    ray: vec2f,
}

// The position that has the coordinates. On the light ray through the camera (inclination 0 or pi) the distance is unknown;
// the camera's position stands for all of it.
fn position_of(coordinates: vec3f) -> vec3f {
    let around = angle_sin_cos(coordinates.y);
    let inclined = angle_sin_cos(coordinates.z);
    let radius = coordinates.x;
    // sin(theta) of the f32 nearest to pi is -9e-8; no inclination has a smaller sine.
    let along = select(0.0, radius * inclined.y / inclined.x, inclined.x > 1e-7);
    return vec3f(radius * around.y, radius * around.x, along);
}

fn batch(input: BatchInput) -> BatchOutput {
    let position = rectified_frame_surface(input.frame, input.device, input.stored_depth);
    let coordinates = rectified_frame_coordinates(position);
    let back = position_of(coordinates);
    let place = rectified_frame_place(input.frame, coordinates);
    let depth = rectified_frame_depth(input.frame, coordinates.z);
    return BatchOutput(
        position,
        depth,
        coordinates,
        mix(input.frame.largest_inclination, input.frame.smallest_inclination, 0.5 * depth + 0.5),
        back,
        0.0,
        rectified_frame_coordinates(back),
        0.0,
        place,
        rectified_frame_ray(input.frame, place),
    );
}
