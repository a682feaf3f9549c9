import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_coordinates, rectified_frame_depth, rectified_frame_inclination, rectified_frame_place, rectified_frame_position, rectified_frame_ray, rectified_frame_surface};

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

fn batch(input: BatchInput) -> BatchOutput {
    let position = rectified_frame_surface(input.frame, input.device, input.stored_depth);
    let coordinates = rectified_frame_coordinates(position);
    let back = rectified_frame_position(coordinates);
    let place = rectified_frame_place(input.frame, coordinates);
    let depth = rectified_frame_depth(input.frame, coordinates.z);
    return BatchOutput(
        position,
        depth,
        coordinates,
        rectified_frame_inclination(input.frame, depth),
        back,
        0.0,
        rectified_frame_coordinates(back),
        0.0,
        place,
        rectified_frame_ray(input.frame, place),
    );
}
