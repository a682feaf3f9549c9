//! Small scenes in which techniques fail in the way that is typical of them.

use glam::{DQuat, DVec3};

use super::shapes::{Shape, ball};
use super::{Material, Scene, Stand};

/// A table on a floor, with two sets of boards above it that cross each other: all that is under the table lies in full
/// shadow, behind two and three occluders that begin and end in the map.
pub fn stacked_boards() -> Scene {
    let mut floor = Shape::new(0);
    floor.cuboid([-4.0, 0.0, -4.0], [4.0, 0.2, 4.0]);
    let mut table = Shape::new(1);
    table.cuboid([-2.4, 1.7, -1.7], [2.4, 1.82, 1.7]);
    for x in [-2.2, 2.2] {
        for z in [-1.5, 1.5] {
            table.cuboid([x - 0.07, 0.2, z - 0.07], [x + 0.07, 1.7, z + 0.07]);
        }
    }
    let mut boards = Shape::new(2);
    for number in -2..=2 {
        let x = 0.95 * f64::from(number);
        boards.cuboid([x - 0.2, 2.9, -1.9], [x + 0.2, 2.96, 1.9]);
    }
    let mut upper = Shape::new(3);
    for number in -1..=1 {
        let z = 1.1 * f64::from(number);
        upper.cuboid([-2.6, 4.2, z - 0.2], [2.6, 4.26, z + 0.2]);
    }
    scene(
        "stacked-boards",
        [floor, table, boards, upper],
        Stand {
            eye: DVec3::new(2.2, 2.1, 5.6),
            target: DVec3::new(0.35, 0.85, 0.2),
            light_direction: DVec3::new(0.3, -1.0, 0.22),
        },
    )
}

/// Things that touch a floor: a box, a ball, thin rods and a leaning board, under a pole that makes the range of depth long.
pub fn contacts() -> Scene {
    let mut floor = Shape::new(0);
    floor.cuboid([-2.2, 0.0, -2.2], [2.2, 0.2, 2.2]);
    let mut solids = Shape::new(1);
    solids.turned_cuboid(
        DVec3::new(-0.9, 0.45, 0.3),
        DVec3::new(0.3, 0.25, 0.3),
        DQuat::from_rotation_y(0.4),
    );
    solids.lathe(DVec3::new(0.75, 0.2, 0.75), DVec3::Y, &ball(0.3, 0.0), 32);
    let mut rods = Shape::new(2);
    for number in 0..6 {
        let x = -0.4 + 0.16 * f64::from(number);
        let base = DVec3::new(x, 0.2, -0.35);
        rods.rod(base, base + 0.9 * DVec3::Y, [0.022, 0.022], 10);
    }
    let pole = DVec3::new(-1.5, 0.2, -1.7);
    rods.rod(pole, pole + 3.2 * DVec3::Y, [0.06, 0.06], 12);
    let mut board = Shape::new(3);
    board.turned_cuboid(
        DVec3::new(1.2, 0.62, -0.4),
        DVec3::new(0.03, 0.6, 0.5),
        DQuat::from_rotation_z(0.75),
    );
    scene(
        "contacts",
        [floor, solids, rods, board],
        Stand {
            eye: DVec3::new(0.55, 1.45, 2.75),
            target: DVec3::new(0.25, 0.4, 0.0),
            light_direction: DVec3::new(0.7, -1.0, 0.45),
        },
    )
}

fn scene(name: &str, shapes: [Shape; 4], stand: Stand) -> Scene {
    Scene {
        name: name.to_owned(),
        meshes: shapes.map(Shape::finish).into(),
        materials: vec![
            Material::plain("floor", [0.62, 0.6, 0.56]),
            Material::plain("solids", [0.5, 0.34, 0.2]),
            Material::plain("boards", [0.36, 0.4, 0.46]),
            Material::plain("upper boards", [0.3, 0.42, 0.3]),
        ],
        stand: Some(stand),
        ..Scene::default()
    }
}
