//! What receiver biases are judged on: plates of every slope against the light, a ball, and boards and posts that stand on the ground.

use glam::{DMat3, DQuat, DVec3};

use super::shapes::{Shape, ball};
use super::{Material, Scene, Stand};

/// The name under which [`load`](super::load) knows the scene.
pub const SLOPES: &str = "slopes-and-feet";

/// The light comes from above and from the right, a little from behind: shadows lie beside what stands on the ground.
const TOWARDS_LIGHT: DVec3 = DVec3::new(0.7, 1.0, -0.2);

/// Nine plates in a row that turn from the light in steps of 10 degrees, the first facing it, and what stands in front of them. Not
/// yet on a ground plane.
pub fn slopes_and_feet() -> Scene {
    let light = TOWARDS_LIGHT.normalize();
    let axis = light.cross(DVec3::Z).normalize();
    let mut plates = Shape::new(0);
    for step in 0..9 {
        let turn = DQuat::from_axis_angle(axis, (10.0 * f64::from(step)).to_radians());
        let normal = turn * light;
        let rotation = DQuat::from_mat3(&DMat3::from_cols(axis, normal, axis.cross(normal)));
        let centre = DVec3::new(0.65 * (f64::from(step) - 4.0), 0.7, -0.8);
        plates.turned_cuboid(centre, DVec3::new(0.2, 0.01, 0.3), rotation);
    }
    let mut solids = Shape::new(1);
    // Thin boards across the light: what lies just behind them is close to what the light sees of them.
    for (x, turn) in [(-2.2, -0.4), (-1.5, 0.0), (-0.8, 0.4)] {
        let (centre, turn) = (DVec3::new(x, 0.2, 0.6), DQuat::from_rotation_y(turn));
        solids.turned_cuboid(centre, DVec3::new(0.006, 0.2, 0.3), turn);
    }
    for number in 0..5 {
        let base = DVec3::new(0.2 * f64::from(number), 0.0, 0.5);
        solids.rod(base, base + 0.6 * DVec3::Y, [0.03; 2], 16);
    }
    let base = DVec3::new(1.9, 0.0, 0.5);
    solids.lathe(base, DVec3::Y, &ball(0.35, 0.0), 48);
    Scene {
        name: SLOPES.to_owned(),
        meshes: vec![plates.finish(), solids.finish()],
        materials: vec![
            Material::plain("plates", [0.62, 0.6, 0.56]),
            Material::plain("solids", [0.5, 0.34, 0.2]),
        ],
        stand: Some(Stand {
            eye: DVec3::new(0.0, 3.0, 3.7),
            target: DVec3::new(0.0, 0.3, 0.0),
            light_direction: -light,
        }),
        ..Scene::default()
    }
}
