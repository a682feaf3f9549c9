//! Cameras of tests, and where the corners of what they see lie: by trigonometry, not by inverting a matrix.

use glam::{DVec3, DVec4};
use moment_shadows::CameraView;

use crate::rows;

/// How a camera projects.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lens {
    /// Tangents of half the angles, an offset of the picture's middle, reversed depth without an end or plain depth.
    Perspective([f64; 2], [f64; 2], bool),
    /// Half the width and height.
    Parallel([f64; 2], bool),
}

pub(crate) const LENSES: [Lens; 5] = [
    Lens::Perspective([0.9, 0.5], [0.0; 2], false),
    Lens::Perspective([0.9, 0.5], [0.0; 2], true),
    Lens::Perspective([0.7, 0.6], [0.3, -0.2], true),
    Lens::Parallel([20.0, 12.0], false),
    Lens::Parallel([20.0, 12.0], true),
];

const NEAR: f64 = 0.1;
const FAR: f64 = 500.0;

#[derive(Clone, Copy, Debug)]
pub(crate) struct Pose {
    pub(crate) lens: Lens,
    pub(crate) eye: DVec3,
    pub(crate) forward: DVec3,
}

impl Pose {
    fn axes(&self) -> [DVec3; 3] {
        let right = self.forward.cross(DVec3::new(0.1, 1.0, 0.2)).normalize();
        [right, right.cross(self.forward), self.forward]
    }

    pub(crate) fn camera(&self) -> CameraView {
        let [right, up, forward] = self.axes().map(|axis| axis.extend(-axis.dot(self.eye)));
        let (reversed, clip) = match self.lens {
            Lens::Perspective([x, y], [across, above], reversed) => {
                let z = if reversed {
                    NEAR * DVec4::W
                } else {
                    (forward - NEAR * DVec4::W) * (FAR / (FAR - NEAR))
                };
                let x = (right - across * forward) / x;
                let y = (up - above * forward) / y;
                (reversed, rows([x, y, z, forward]))
            }
            Lens::Parallel([x, y], reversed) => {
                let z = (forward - NEAR * DVec4::W) / (FAR - NEAR);
                let z = if reversed { DVec4::W - z } else { z };
                (reversed, rows([right / x, up / y, z, DVec4::W]))
            }
        };
        CameraView {
            // Of clip space only ratios count.
            clip_from_world: (2.5 * clip).to_cols_array_2d(),
            far_depth: if reversed { 0.0 } else { 1.0 },
        }
    }

    /// A corner of what is seen at a distance as cascades count it.
    pub(crate) fn corner(&self, distance: f64, [x, y]: [f64; 2]) -> DVec3 {
        let [right, up, forward] = self.axes();
        let (distance, [x, y]) = match self.lens {
            Lens::Perspective(tangents, offset, _) => (
                distance,
                [x * tangents[0] + offset[0], y * tangents[1] + offset[1]].map(|it| it * distance),
            ),
            Lens::Parallel(half, _) => (distance + NEAR, [x * half[0], y * half[1]]),
        };
        self.eye + forward * distance + right * x + up * y
    }
}
