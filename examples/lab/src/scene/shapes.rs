//! Simple solids from which the procedural scenes are built. Lengths are metres, y is up.

use std::f64::consts::TAU;

use glam::{DQuat, DVec2, DVec3};

use super::Mesh;

/// A mesh of one material that grows by solids.
pub(super) struct Shape(Mesh);

impl Shape {
    /// An empty mesh of material `material`.
    pub(super) fn new(material: usize) -> Self {
        Self(Mesh {
            material,
            ..Mesh::default()
        })
    }

    /// The mesh.
    pub(super) fn finish(self) -> Mesh {
        self.0
    }

    fn vertex(&mut self, position: DVec3, normal: DVec3, uv: [f32; 2]) -> u32 {
        self.0.positions.push(position.as_vec3().to_array());
        self.0.normals.push(normal.as_vec3().to_array());
        self.0.uvs.push(uv);
        self.0.positions.len() as u32 - 1
    }

    /// A triangle with its own normal.
    pub(super) fn triangle(&mut self, corners: [DVec3; 3]) {
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for corner in corners {
            let index = self.vertex(corner, normal, [0.0; 2]);
            self.0.indices.push(index);
        }
    }

    /// A flat quadrilateral, counter-clockwise from the texture's bottom left.
    pub(super) fn quad(&mut self, corners: [DVec3; 4]) {
        let [a, b, c, d] = corners;
        let normal = (c - a).cross(d - b).normalize_or_zero();
        let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
        let first = self.0.positions.len() as u32;
        for (corner, uv) in corners.into_iter().zip(uvs) {
            self.vertex(corner, normal, uv);
        }
        self.0
            .indices
            .extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
    }

    /// A box with half edges `half`, turned by `rotation`.
    pub(super) fn turned_cuboid(&mut self, centre: DVec3, half: DVec3, rotation: DQuat) {
        for axis in 0..3 {
            for side in [-1.0, 1.0] {
                let mut unit = [DVec3::ZERO; 3];
                for (offset, direction) in unit.iter_mut().enumerate() {
                    let index = (axis + offset) % 3;
                    direction[index] = half[index];
                    *direction = rotation * *direction;
                }
                let [out, u, v] = [unit[0] * side, unit[1] * side, unit[2]];
                let middle = centre + out;
                self.quad([
                    middle - u - v,
                    middle + u - v,
                    middle + u + v,
                    middle - u + v,
                ]);
            }
        }
    }

    /// A box along the axes between two corners.
    pub(super) fn cuboid(&mut self, low: [f64; 3], high: [f64; 3]) {
        let [low, high] = [low, high].map(DVec3::from_array);
        self.turned_cuboid(0.5 * (low + high), 0.5 * (high - low), DQuat::IDENTITY);
    }

    /// A solid of revolution about the axis from `base` along `axis`: `profile` lists radius and height, bottom first.
    pub(super) fn lathe(&mut self, base: DVec3, axis: DVec3, profile: &[[f64; 2]], segments: u32) {
        let (side, other) = axis.normalize_or(DVec3::Y).any_orthonormal_pair();
        let axis = axis.normalize_or(DVec3::Y);
        for pair in profile.windows(2) {
            let [low, high] = [pair[0], pair[1]].map(DVec2::from_array);
            let along = (high - low).normalize_or_zero();
            let first = self.0.positions.len() as u32;
            for segment in 0..=segments {
                let (sin, cos) = (TAU * f64::from(segment) / f64::from(segments)).sin_cos();
                let out = cos * side + sin * other;
                let normal = (along.y * out - along.x * axis).normalize_or_zero();
                for ring in [low, high] {
                    self.vertex(base + ring.x * out + ring.y * axis, normal, [0.0; 2]);
                }
            }
            for segment in 0..segments {
                let at = first + 2 * segment;
                self.0
                    .indices
                    .extend([at, at + 2, at + 1, at + 1, at + 2, at + 3]);
            }
        }
    }

    /// A round rod that may taper.
    pub(super) fn rod(&mut self, from: DVec3, to: DVec3, radii: [f64; 2], segments: u32) {
        let length = (to - from).length();
        self.lathe(
            from,
            to - from,
            &[
                [0.0, 0.0],
                [radii[0], 0.0],
                [radii[1], length],
                [0.0, length],
            ],
            segments,
        );
    }

    /// A ring of radius `radius` about `axis`, of round wire.
    pub(super) fn ring(&mut self, centre: DVec3, axis: DVec3, radius: f64, wire: f64) {
        const AROUND: u32 = 24;
        let (side, other) = axis.normalize_or(DVec3::Z).any_orthonormal_pair();
        let at = |step: u32| {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(AROUND)).sin_cos();
            centre + radius * (cos * side + sin * other)
        };
        for step in 0..AROUND {
            self.rod(at(step), at(step + 1), [wire, wire], 6);
        }
    }
}

/// The profile of a ball of radius `radius` whose lowest point is at height `height`.
pub(super) fn ball(radius: f64, height: f64) -> Vec<[f64; 2]> {
    const RINGS: u32 = 10;
    (0..=RINGS)
        .map(|ring| {
            let (sin, cos) = (0.5 * TAU * f64::from(ring) / f64::from(RINGS)).sin_cos();
            [radius * sin, height + radius * (1.0 - cos)]
        })
        .collect()
}
