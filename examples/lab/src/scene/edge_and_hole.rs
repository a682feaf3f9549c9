//! Scenes whose penumbrae are known beforehand: straight edges above the ground, and a wall with a small hole.

use glam::DVec3;

use super::ground::add_ground;
use super::shapes::Shape;
use super::{Material, Mesh, Scene, Stand};

/// The name under which [`load`](super::load) knows [`straight_edges`].
pub const EDGE: &str = "edge";

/// The name under which [`load`](super::load) knows [`small_hole`].
pub const HOLE: &str = "hole";

/// Heights of the boards of [`straight_edges`] above the ground, in scene units.
pub const EDGE_HEIGHTS: [f64; 3] = [0.5, 1.0, 2.0];

/// Length of each board's edge.
const EDGE_LENGTH: f64 = 3.0;

/// How far the boards reach from their edges.
const BOARD: f64 = 4.0;

/// Half-planes above the ground, as far as the light of this scene can tell: three boards without thickness, at
/// [`EDGE_HEIGHTS`], that cover x below 0 in one [`edge_strip`] each. Their edges run along z at x = 0. The light comes from
/// the side that they cover.
pub fn straight_edges() -> Scene {
    let mut shape = Shape::new(0);
    for (number, height) in EDGE_HEIGHTS.into_iter().enumerate() {
        let [low, high] = edge_strip(number);
        board(&mut shape, [-BOARD, 0.0], [low, high], height);
    }
    let stand = Stand {
        eye: DVec3::new(5.0, 6.4, 2.6),
        target: DVec3::new(0.35, 0.0, 0.0),
        light_direction: DVec3::new(0.5, -1.0, 0.0),
    };
    above_ground(EDGE, shape.finish(), stand)
}

/// Where along z a board of [`straight_edges`] begins and ends.
#[must_use]
pub fn edge_strip(number: usize) -> [f64; 2] {
    let low = EDGE_LENGTH * (number as f64 - 0.5 * EDGE_HEIGHTS.len() as f64);
    [low, low + EDGE_LENGTH]
}

/// A wall across the light with a hole that is small beside the light: behind it lies the light's picture, upside down.
pub fn small_hole() -> Scene {
    let (half, hole, height) = (1.3, 0.02, 4.0);
    let mut shape = Shape::new(0);
    for side in [-1.0, 1.0] {
        let across = [side * hole, side * half];
        board(&mut shape, sorted(across), [-half, half], height);
        board(&mut shape, [-hole, hole], sorted(across), height);
    }
    let stand = Stand {
        eye: DVec3::new(0.0, 0.7, 0.8),
        target: DVec3::new(0.0, 0.0, 0.0),
        light_direction: DVec3::NEG_Y,
    };
    above_ground(HOLE, shape.finish(), stand)
}

fn sorted([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// A level board without thickness.
fn board(shape: &mut Shape, [left, right]: [f64; 2], [back, front]: [f64; 2], height: f64) {
    let corner = |x, z| DVec3::new(x, height, z);
    shape.quad([
        corner(left, front),
        corner(right, front),
        corner(right, back),
        corner(left, back),
    ]);
}

fn above_ground(name: &str, mesh: Mesh, stand: Stand) -> Scene {
    let mut scene = Scene {
        name: name.to_owned(),
        meshes: vec![mesh],
        materials: vec![Material {
            double_sided: true,
            ..Material::plain("boards", [0.36, 0.4, 0.46])
        }],
        stand: Some(stand),
        ..Scene::default()
    };
    let radius = scene.bounds().radius();
    add_ground(&mut scene, radius);
    scene
}
