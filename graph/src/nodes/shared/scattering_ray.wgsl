import node::camera_depth::{CameraPixel, camera_depth_at, camera_depth_clip};
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_depth, rectified_frame_direction, rectified_frame_place, rectified_frame_view_ray, rectified_frame_w};

// The view ray of a pixel, up to its surface or the far end.
struct ScatteringRay {
    length: f32,
    // Of the angle between the directions of the light and the view ray.
    cosine: f32,
    // Where it ends across the columns and rows of rectified maps, from 0 to 1.
    place: vec2f,
    // Its rectified depth in [-1, 1].
    depth: f32,
}

fn scattering_ray_of(frame: RectifiedFrame, pixel: CameraPixel) -> ScatteringRay {
    let clip = camera_depth_clip(pixel, camera_depth_at(pixel.pixel));
    let direction = rectified_frame_direction(frame, clip.xy);
    let per_w = 1.0 / rectified_frame_w(frame, clip.xy, clip.z);
    let ray = rectified_frame_view_ray(direction);
    return ScatteringRay(
        ray.length * per_w,
        direction.z / max(ray.length, 1e-30),
        rectified_frame_place(frame, ray.coordinates * vec3f(per_w, 1.0, 1.0)),
        rectified_frame_depth(frame, ray.coordinates.z),
    );
}
