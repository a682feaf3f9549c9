//! Limits on a whole scene: instances multiply what is small by itself.

use std::path::Path;

use super::accessor::MOST_ELEMENTS;
use super::{Mesh, SceneError};

/// The most primitives of a scene, one of a mesh counted for each node that shows it.
const MOST_PRIMITIVES: u64 = 1 << 20;

/// What a scene has so far.
#[derive(Default)]
pub(super) struct Total {
    primitives: u64,
    vertices: u64,
    triangles: u64,
}

impl Total {
    /// Counts a primitive before it is loaded.
    pub(super) fn count_primitive(&mut self, file: &Path, item: &str) -> Result<(), SceneError> {
        self.primitives += 1;
        within(file, item, "primitives", self.primitives, MOST_PRIMITIVES)
    }

    /// Counts what a primitive became.
    pub(super) fn count(&mut self, file: &Path, item: &str, mesh: &Mesh) -> Result<(), SceneError> {
        self.vertices += mesh.positions.len() as u64;
        self.triangles += mesh.indices.len() as u64 / 3;
        within(file, item, "vertices", self.vertices, MOST_ELEMENTS)?;
        within(file, item, "triangles", self.triangles, MOST_ELEMENTS)
    }
}

fn within(
    file: &Path,
    item: &str,
    unit: &'static str,
    count: u64,
    limit: u64,
) -> Result<(), SceneError> {
    if count <= limit {
        return Ok(());
    }
    Err(SceneError::TooLarge {
        file: file.to_owned(),
        item: format!("the scene up to {item}"),
        count,
        unit,
        limit,
    })
}
