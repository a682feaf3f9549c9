//! Thin contacts: chairs whose legs meet the ground, where shadows begin at nothing.

use glam::{DQuat, DVec3};

use super::shapes::Shape;
use super::{Material, Mesh, Scene};

/// The name under which [`load`](super::load) knows the scene.
pub const CHAIRS: &str = "chairs";

const LEGS: usize = 0;
const WOOD: usize = 1;

/// Half the width of a leg: 24 mm square.
const HALF_LEG: f64 = 0.012;
/// Half the distance between the middles of two legs, and the height of the seat.
const HALF_SEAT: f64 = 0.19;
const SEAT: f64 = 0.45;

/// Where a leg stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// The middle of what touches the ground.
    pub centre: DVec3,
    /// The distance of its farthest corner from there.
    pub radius: f64,
}

/// Six chairs of 0.9 m, each turned another way. Every leg is a mesh of its own. Not yet on a ground plane.
pub fn chairs() -> Scene {
    let places = [
        (-0.9, -0.5, 0.2),
        (0.0, -0.55, -0.5),
        (0.95, -0.45, 1.1),
        (-0.85, 0.5, 2.6),
        (0.1, 0.45, 0.75),
        (0.9, 0.55, -2.2),
    ];
    Scene {
        name: CHAIRS.to_owned(),
        meshes: places
            .into_iter()
            .flat_map(|(x, z, turn)| chair(DVec3::new(x, 0.0, z), DQuat::from_rotation_y(turn)))
            .collect(),
        materials: vec![
            Material::plain("legs", [0.36, 0.24, 0.15]),
            Material::plain("wood", [0.5, 0.36, 0.22]),
        ],
        ..Scene::default()
    }
}

fn chair(place: DVec3, turn: DQuat) -> Vec<Mesh> {
    let cuboid = |shape: &mut Shape, centre: [f64; 3], half: [f64; 3]| {
        let centre = place + turn * DVec3::from_array(centre);
        shape.turned_cuboid(centre, DVec3::from_array(half), turn);
    };
    let mut meshes = Vec::new();
    for [x, z] in [[-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]] {
        let mut leg = Shape::new(LEGS);
        // Those at the back go on as the posts of the rest.
        let height = if z < 0.0 { 0.9 } else { SEAT };
        cuboid(
            &mut leg,
            [x * HALF_SEAT, 0.5 * height, z * HALF_SEAT],
            [HALF_LEG, 0.5 * height, HALF_LEG],
        );
        meshes.push(leg.finish());
    }
    let mut wood = Shape::new(WOOD);
    cuboid(&mut wood, [0.0, SEAT, 0.0], [0.21, 0.012, 0.21]);
    for height in [0.6, 0.7, 0.8, 0.88] {
        cuboid(
            &mut wood,
            [0.0, height, -HALF_SEAT],
            [HALF_SEAT, 0.02, 0.006],
        );
    }
    // Rungs between the legs.
    for side in [-1.0, 1.0] {
        cuboid(
            &mut wood,
            [side * HALF_SEAT, 0.16, 0.0],
            [0.007, 0.007, HALF_SEAT],
        );
    }
    meshes.push(wood.finish());
    meshes
}

/// The feet of all legs of [`chairs`], as they stand.
#[must_use]
pub fn feet(scene: &Scene) -> Vec<Foot> {
    let legs = scene.meshes.iter();
    legs.filter(|mesh| mesh.material == LEGS && !mesh.ground)
        .filter_map(foot)
        .collect()
}

fn foot(leg: &Mesh) -> Option<Foot> {
    let corners: Vec<DVec3> = leg
        .positions
        .iter()
        .map(|&position| DVec3::from_array(position.map(f64::from)))
        .collect();
    let lowest = corners.iter().map(|corner| corner.y).reduce(f64::min)?;
    let touching: Vec<DVec3> = corners
        .into_iter()
        .filter(|corner| corner.y < lowest + HALF_LEG)
        .collect();
    let centre = touching.iter().sum::<DVec3>() / touching.len() as f64;
    let distances = touching.iter().map(|corner| corner.distance(centre));
    Some(Foot {
        centre,
        radius: distances.fold(0.0, f64::max),
    })
}
