//! What a camera sees between two distances.

use glam::{DMat4, DVec3};

use super::{CameraView, inverse, singular};
use crate::ValueError;

/// The four edges of a camera's frustum. At the distance `t` along the camera's axis an edge is at `origin + t step`.
pub(super) struct Frustum {
    edges: [[DVec3; 2]; 4],
}

impl Frustum {
    /// Distances count from the camera, or, where its rays are parallel, from its near plane.
    pub(super) fn new(camera: &CameraView) -> Result<Self, ValueError> {
        let clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
        let [x, y, z, middle] = {
            let inverse = inverse(clip, "camera")?;
            [
                inverse.x_axis,
                inverse.y_axis,
                inverse.z_axis,
                inverse.w_axis,
            ]
        };
        let axis = clip.row(3).truncate();
        let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
        let edges = corners.map(|[across, up]| {
            let at_zero = across * x + up * y + middle;
            if axis == DVec3::ZERO {
                let far = f64::from(camera.far_depth);
                let near = at_zero + (1.0 - far) * z;
                let along = (2.0 * far - 1.0) * z.truncate() * near.w.signum();
                return [near.truncate() / near.w, along.normalize()];
            }
            // All rays meet where clip x, y and w are 0. A position less that one, times its homogeneous coordinate, does not
            // depend on depth.
            let eye = z.truncate() / z.w;
            let along = at_zero.truncate() - at_zero.w * eye;
            [eye, along * (axis.length() / axis.dot(along))]
        });
        let frustum = Self { edges };
        let finite = frustum.edges.as_flattened().iter();
        if finite.copied().all(DVec3::is_finite) {
            Ok(frustum)
        } else {
            Err(singular("camera"))
        }
    }

    /// A sphere around what lies between two distances. Its radius does not depend on where the camera is and looks; for
    /// frusta without an offset it is the smallest one.
    pub(super) fn sphere(&self, [near, far]: [f64; 2]) -> (DVec3, f64) {
        let mean = |index: usize| 0.25 * self.edges.iter().map(|edge| edge[index]).sum::<DVec3>();
        let (origin, axis) = (mean(0), mean(1));
        // Relative to the origin, which may be far away.
        let edges = self.edges.map(|[start, step]| [start - origin, step]);
        let spread = edges.map(|[_, step]| (step - axis).length_squared());
        let spread = spread.into_iter().fold(0.0, f64::max);
        // As far from the corners in front as from those behind, unless those behind alone are so far apart.
        let middle = (0.5 * (near + far) * (1.0 + spread)).min(far);
        let distance =
            |[start, step]: [DVec3; 2], at: f64| (start + at * step - middle * axis).length();
        let distances = edges.map(|edge| distance(edge, near).max(distance(edge, far)));
        let radius = distances.into_iter().fold(0.0, f64::max);
        (origin + middle * axis, radius)
    }
}
