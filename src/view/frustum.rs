//! What a camera sees between two distances.

use glam::{DMat4, DVec3};

use super::{CameraView, singular};
use crate::ValueError;

/// The smallest volume that three directions of length 1 span: those of a picture that is not flat.
const SMALLEST_VOLUME: f64 = 1e-9;

/// The four edges of a camera's frustum. At the distance `t` along the camera's axis an edge is at `origin + t step`.
pub(super) struct Frustum {
    edges: [[DVec3; 2]; 4],
}

impl Frustum {
    /// Distances count from the camera, or, where its rays are parallel, from its near plane. How a perspective camera stores depth does
    /// not matter, nor what that loses in digits.
    pub(super) fn new(camera: &CameraView) -> Result<Self, ValueError> {
        let clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
        let [x, y, z, w] = [0, 1, 2, 3].map(|index| clip.row(index));
        let parallel = w.truncate() == DVec3::ZERO;
        let given = [x, y, if parallel { z } else { w }];
        let [a, b, c] = given.map(|row| row.truncate());
        let constants = DVec3::from(given.map(|row| row.w));
        let volume = a.dot(b.cross(c));
        // False for what is no number.
        let spans = volume.abs() > SMALLEST_VOLUME * a.length() * b.length() * c.length();
        // The place with these three coordinates.
        let solved =
            |at: DVec3| (at.x * b.cross(c) + at.y * c.cross(a) + at.z * a.cross(b)) / volume;
        let far = f64::from(camera.far_depth);
        let corners = [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]];
        let edges = corners.map(|[across, up]| {
            if parallel {
                let near = solved(DVec3::new(across, up, 1.0 - far) * w.w - constants);
                let along = solved(DVec3::Z * (2.0 * far - 1.0) * w.w);
                return [near, along.normalize()];
            }
            let step = solved(DVec3::new(across, up, 1.0)) * c.length();
            [solved(-constants), step]
        });
        let finite = edges.as_flattened().iter().copied().all(DVec3::is_finite);
        if spans && finite && clip.is_finite() {
            Ok(Self { edges })
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
