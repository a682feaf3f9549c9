//! Putting a scene on a ground plane.

use super::{Material, Mesh, Scene};

/// Half the ground's edge in radii of the scene: the shadow of a sun 4 degrees above the horizon still falls on it.
const GROUND_RADII: f64 = 30.0;

/// Moves the scene so that its lowest point lies at y = 0 and its middle above the origin, and adds a ground plane.
pub fn place_on_ground(mut scene: Scene) -> Scene {
    let bounds = scene.bounds();
    let centre = bounds.centre();
    let offset = [centre.x, bounds.min.y, centre.z];
    scene.origin += glam::DVec3::from_array(offset);
    for position in scene.meshes.iter_mut().flat_map(|mesh| &mut mesh.positions) {
        for (coordinate, offset) in position.iter_mut().zip(offset) {
            *coordinate = (f64::from(*coordinate) - offset) as f32;
        }
    }
    if let Some(stand) = &mut scene.stand {
        stand.eye -= glam::DVec3::from_array(offset);
        stand.target -= glam::DVec3::from_array(offset);
    }
    add_ground(&mut scene, bounds.radius());
    scene
}

/// Adds a ground plane at y = 0 to a scene of this radius.
pub(super) fn add_ground(scene: &mut Scene, radius: f64) {
    let half = (GROUND_RADII * radius).max(f64::from(f32::MIN_POSITIVE)) as f32;
    scene.meshes.push(Mesh {
        positions: vec![
            [-half, 0.0, -half],
            [-half, 0.0, half],
            [half, 0.0, half],
            [half, 0.0, -half],
        ],
        normals: vec![[0.0, 1.0, 0.0]; 4],
        uvs: vec![[0.0; 2]; 4],
        alphas: Vec::new(),
        indices: vec![0, 1, 2, 0, 2, 3],
        material: scene.materials.len(),
        ground: true,
    });
    scene
        .materials
        .push(Material::plain("ground", [0.4, 0.385, 0.36]));
    scene.ground = Some(0.0);
}
