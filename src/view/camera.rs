//! A camera.

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// From scene to clip space, by columns; wgpu's clip space, with depth as the camera's texture stores it.
    pub clip_from_world: [[f64; 4]; 4],
    /// The stored depth of pixels that show no surface: 0 for reversed depth, 1 for forward depth.
    pub far_depth: f32,
}
