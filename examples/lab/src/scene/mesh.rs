//! Indexed triangles and their bounds.

use glam::DVec3;

/// Indexed triangles in world space. All attributes but `alphas` have one entry per vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Positions, finite.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals for shading, or zero where none is known.
    pub normals: Vec<[f32; 3]>,
    /// Texture coordinates, (0, 0) at the image's top left.
    pub uvs: Vec<[f32; 2]>,
    /// Alpha, which masked materials multiply with theirs; empty where it is 1.
    pub alphas: Vec<f32>,
    /// Three per triangle, each below the number of vertices.
    pub indices: Vec<u32>,
    /// Index of the material in the scene.
    pub material: usize,
    /// Whether this is the ground plane: it receives shadows, and lights are not fitted to it.
    pub ground: bool,
}

/// A box along the axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Its lowest corner.
    pub min: DVec3,
    /// Its highest corner.
    pub max: DVec3,
}

impl Bounds {
    /// The box around `points`; without points the box of the origin alone.
    pub fn of(points: impl Iterator<Item = DVec3>) -> Self {
        points
            .map(|point| Self {
                min: point,
                max: point,
            })
            .reduce(|a, b| Self {
                min: a.min.min(b.min),
                max: a.max.max(b.max),
            })
            .unwrap_or(Self {
                min: DVec3::ZERO,
                max: DVec3::ZERO,
            })
    }

    /// Its centre.
    pub fn centre(&self) -> DVec3 {
        0.5 * (self.min + self.max)
    }

    /// Its edges' lengths.
    pub fn size(&self) -> DVec3 {
        self.max - self.min
    }

    /// Half its diagonal.
    pub fn radius(&self) -> f64 {
        0.5 * self.size().length()
    }
}
