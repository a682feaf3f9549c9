//! Scenes: triangles in world space with the little of materials that shadows need.

mod caught;
mod chairs;
mod edge_and_hole;
mod extensions;
mod failures;
mod fence_and_foliage;
mod gltf_file;
mod gltf_instances;
mod gltf_material;
mod gltf_mesh;
mod gltf_source;
mod ground;
mod hall;
mod material;
mod mesh;
mod mips;
mod shapes;
mod slopes;

use std::path::Path;

use glam::DVec3;

pub use chairs::{CHAIRS, Foot, chairs, feet};
pub use edge_and_hole::{EDGE, EDGE_HEIGHTS, HOLE, edge_strip, small_hole, straight_edges};
pub use extensions::{EXTENSIONS, Extensions};
pub use failures::{contacts, stacked_boards};
pub use fence_and_foliage::fence_and_foliage;
pub use gltf_file::load_gltf;
pub use ground::place_on_ground;
pub use hall::hall_with_open_roof;
pub use material::{Image, Material};
pub use mesh::{Bounds, Mesh};
pub(crate) use mips::mips;
pub use slopes::{SLOPES, slopes_and_feet};

use crate::error::LabError;

/// Names under which [`load`] knows the procedural scenes that techniques are compared on; there are also [`CHAIRS`],
/// [`SLOPES`], [`EDGE`] and [`HOLE`].
pub const PROCEDURAL: [&str; 2] = ["fence-and-foliage", "hall"];

/// Where to stand in a scene that should not be looked at from every side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// The camera's position.
    pub eye: DVec3,
    /// What it looks at.
    pub target: DVec3,
    /// Along which the sun shines.
    pub light_direction: DVec3,
}

/// Triangles in world space (y is up), flattened from whatever hierarchy they had.
#[derive(Clone, Debug, Default)]
pub struct Scene {
    /// A short name: the file's, or that of the procedural scene.
    pub name: String,
    /// The triangles, one mesh per primitive and instance.
    pub meshes: Vec<Mesh>,
    /// What the meshes' `material` counts in. Never empty if there is a mesh.
    pub materials: Vec<Material>,
    /// What the materials' `texture` counts in.
    pub images: Vec<Image>,
    /// What of the file, or of the procedural scene, has been moved to zero.
    pub origin: DVec3,
    /// Height of the ground plane, if the scene stands on one.
    pub ground: Option<f64>,
    /// Whether views and lights are fitted to the box around the casters, which files have in common that say the same in other
    /// triangles; otherwise to the casters themselves, which is tighter.
    pub in_box: bool,
    /// Where to stand; `None` to look at the scene from outside.
    pub stand: Option<Stand>,
    /// What was left out on loading, a sentence each.
    pub warnings: Vec<String>,
}

impl Scene {
    /// The box around all meshes but the ground.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(self.casters())
    }

    /// What views and lights are fitted to.
    #[must_use]
    pub fn extremes(&self) -> Vec<DVec3> {
        if !self.in_box {
            return self.casters().collect();
        }
        let Bounds { min, max } = self.bounds();
        let corner = |index: usize| {
            let of = |axis: usize| {
                if index >> axis & 1 == 0 {
                    min[axis]
                } else {
                    max[axis]
                }
            };
            DVec3::new(of(0), of(1), of(2))
        };
        (0..8).map(corner).collect()
    }

    /// The corners of all triangles but the ground's.
    pub fn casters(&self) -> impl Iterator<Item = DVec3> + '_ {
        let casters = self.meshes.iter().filter(|mesh| !mesh.ground);
        casters.flat_map(|mesh| {
            let corners = mesh.indices.iter();
            let positions = corners.filter_map(|&corner| mesh.positions.get(corner as usize));
            positions.map(|&[x, y, z]| DVec3::new(f64::from(x), f64::from(y), f64::from(z)))
        })
    }

    /// This scene where nothing but its casters receives shadows.
    #[must_use]
    pub fn without_ground(mut self) -> Self {
        self.meshes.retain(|mesh| !mesh.ground);
        self.ground = None;
        self
    }

    /// How many triangles there are, those of the ground included.
    pub fn triangles(&self) -> usize {
        self.meshes.iter().map(|mesh| mesh.indices.len() / 3).sum()
    }
}

/// The scene that a command line names: a file, one of [`PROCEDURAL`], [`CHAIRS`], [`SLOPES`], [`EDGE`] or [`HOLE`]. It stands on its
/// ground plane, or hovers above it. What a file has and the scene has not is said on the standard error.
///
/// Blended materials are opaque to all that is done with it, which is said, too.
pub fn load(name: &str) -> Result<Scene, LabError> {
    let scene = load_blended(name)?;
    for material in scene.materials.iter().filter(|material| material.blend) {
        eprintln!(
            "warning: {name}: material '{}' is translucent (BLEND), but opaque here; 'moment-shadows-lab transmittance --scene' blends it",
            material.name
        );
    }
    Ok(scene)
}

/// The same for what blends its translucent materials.
pub fn load_blended(name: &str) -> Result<Scene, LabError> {
    match name {
        "fence-and-foliage" => Ok(place_on_ground(fence_and_foliage())),
        "hall" => Ok(place_on_ground(hall_with_open_roof())),
        CHAIRS => Ok(place_on_ground(chairs())),
        SLOPES => Ok(place_on_ground(slopes_and_feet())),
        EDGE => Ok(straight_edges()),
        HOLE => Ok(small_hole()),
        _ if Path::new(name).exists() => {
            let scene = load_gltf(Path::new(name))?;
            for warning in &scene.warnings {
                eprintln!("warning: {name}: {warning}");
            }
            Ok(place_on_ground(scene))
        }
        _ => Err(LabError::refused(format!(
            "there is no file '{name}', nor a procedural scene of that name; the procedural scenes are {}, {CHAIRS}, {SLOPES}, \
             {EDGE} and {HOLE}",
            PROCEDURAL.join(", ")
        ))),
    }
}
