//! Long ranges: a hall whose roof is open, so that light falls far through beams, slats and windows.

use glam::{DQuat, DVec3};

use super::shapes::{Shape, ball};
use super::{Material, Mesh, Scene, Stand};

const PLASTER: usize = 0;
const MARBLE: usize = 1;
const TIMBER: usize = 2;
const IRON: usize = 3;
const CRATES: usize = 4;

/// Half the width between the walls.
const HALF: f64 = 5.5;
/// Where the hall ends, and where it opens towards the viewer.
const ENDS: [f64; 2] = [-20.0, 20.0];
/// Height of the walls and of the beams on them.
const EAVES: f64 = 7.0;

/// A hall of 40 x 11 x 8 m with columns, windows on one side, and a roof of beams and slats that is closed only
/// above its far end. Not yet on a ground plane.
pub fn hall_with_open_roof() -> Scene {
    Scene {
        name: "hall".to_owned(),
        meshes: vec![walls(), columns(), roof(), lamps(), crates()],
        materials: vec![
            Material::plain("plaster", [0.66, 0.6, 0.52]),
            Material::plain("marble", [0.72, 0.71, 0.68]),
            Material::plain("timber", [0.3, 0.19, 0.11]),
            Material::plain("iron", [0.07, 0.07, 0.075]),
            Material::plain("crates", [0.45, 0.31, 0.17]),
        ],
        stand: Some(Stand {
            eye: DVec3::new(1.3, 2.5, 19.5),
            target: DVec3::new(-0.6, 2.6, 0.0),
            light_direction: DVec3::new(0.42, -0.56, 0.71),
        }),
        ..Scene::default()
    }
}

/// The wall with windows on the left, a plain one on the right, and one with a door at the far end.
fn walls() -> Mesh {
    let mut shape = Shape::new(PLASTER);
    let [far, near] = ENDS;
    let thick = 0.4;
    shape.cuboid([HALF, 0.0, far], [HALF + thick, EAVES, near]);
    shape.cuboid([-HALF - thick, 0.0, far], [-HALF, 1.1, near]);
    shape.cuboid([-HALF - thick, 5.2, far], [-HALF, EAVES, near]);
    let piers = 10;
    for pier in 0..=piers {
        let middle = far + (near - far) * f64::from(pier) / f64::from(piers);
        let low = (middle - 1.2).max(far);
        let high = (middle + 1.2).min(near);
        shape.cuboid([-HALF - thick, 1.1, low], [-HALF, 5.2, high]);
    }
    shape.cuboid([-HALF, 0.0, far - thick], [-1.2, EAVES, far]);
    shape.cuboid([1.2, 0.0, far - thick], [HALF, EAVES, far]);
    shape.cuboid([-1.2, 3.2, far - thick], [1.2, EAVES, far]);
    shape.finish()
}

/// Two rows of columns with bases and capitals.
fn columns() -> Mesh {
    let mut shape = Shape::new(MARBLE);
    for number in 0..10 {
        for x in [-3.4, 3.4] {
            let base = DVec3::new(x, 0.0, ENDS[0] + 2.0 + 4.0 * f64::from(number));
            shape.cuboid(
                [base.x - 0.42, 0.0, base.z - 0.42],
                [base.x + 0.42, 0.18, base.z + 0.42],
            );
            let profile = [
                [0.4, 0.18],
                [0.42, 0.24],
                [0.4, 0.3],
                [0.32, 0.36],
                [0.32, 2.0],
                [0.27, 5.5],
                [0.3, 5.55],
                [0.27, 5.6],
                [0.27, 5.7],
                [0.42, 5.9],
            ];
            shape.lathe(base, DVec3::Y, &profile, 28);
            shape.cuboid(
                [base.x - 0.46, 5.9, base.z - 0.46],
                [base.x + 0.46, 6.1, base.z + 0.46],
            );
        }
    }
    shape.finish()
}

/// Beams along and across the hall, slats above them, and planks that close the roof above the far end.
fn roof() -> Mesh {
    let mut shape = Shape::new(TIMBER);
    let [far, near] = ENDS;
    for x in [-3.4, 3.4] {
        shape.cuboid([x - 0.18, 6.1, far], [x + 0.18, 6.5, near]);
    }
    for number in 0..10 {
        let z = far + 2.0 + 4.0 * f64::from(number);
        shape.cuboid([-HALF, 6.5, z - 0.14], [HALF, 6.9, z + 0.14]);
        // Struts from the columns to the cross beam.
        for side in [-1.0, 1.0] {
            let turn = DQuat::from_rotation_z(side * 0.8);
            let middle = DVec3::new(side * (3.4 - 0.65), 5.95, z);
            shape.turned_cuboid(middle, DVec3::new(0.06, 0.85, 0.07), turn);
        }
    }
    for number in 0..9 {
        let x = -HALF + 0.4 + (2.0 * HALF - 0.8) * f64::from(number) / 8.0;
        shape.cuboid([x - 0.06, 6.9, far], [x + 0.06, 7.06, near]);
    }
    let mut z = far + 0.3;
    while z < near {
        if z < -11.0 {
            shape.cuboid([-HALF, 7.06, z - 0.3], [HALF, 7.1, z + 0.29]);
            z += 0.6;
        } else {
            shape.cuboid([-HALF, 7.06, z - 0.06], [HALF, 7.12, z + 0.06]);
            z += 0.8;
        }
    }
    shape.finish()
}

/// Round lamps that hang on thin rods.
fn lamps() -> Mesh {
    let mut shape = Shape::new(IRON);
    for number in 0..4 {
        let hang = DVec3::new(0.0, 6.5, -10.0 + 8.0 * f64::from(number));
        let low = hang - 2.6 * DVec3::Y;
        shape.rod(low, hang, [0.012, 0.012], 8);
        shape.ring(low, DVec3::Y, 0.7, 0.02);
        for spoke in 0..6 {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(spoke) / 6.0).sin_cos();
            let rim = low + 0.7 * DVec3::new(cos, 0.0, sin);
            shape.rod(rim, low + 0.6 * DVec3::Y, [0.008, 0.008], 6);
            shape.lathe(rim, DVec3::Y, &ball(0.07, 0.0), 12);
        }
    }
    shape.finish()
}

/// Crates and a ladder, so that there are contacts on the floor and against a wall.
fn crates() -> Mesh {
    let mut shape = Shape::new(CRATES);
    for (x, y, z, half, turn) in [
        (-1.6, 0.0, 9.0, 0.5, 0.3),
        (-0.4, 0.0, 8.6, 0.4, -0.2),
        (-1.5, 1.0, 9.05, 0.35, 0.8),
        (1.4, 0.0, 2.0, 0.45, 0.5),
        (4.6, 0.0, 6.0, 0.5, 0.1),
        (-1.0, 0.0, -5.0, 0.6, 0.9),
    ] {
        let turn = DQuat::from_rotation_y(turn);
        let centre = DVec3::new(x, y + half, z);
        shape.turned_cuboid(centre, DVec3::splat(0.96 * half), turn);
        for corner in 0..4 {
            let [a, b] = [corner & 1, corner >> 1].map(|bit| f64::from(bit) * 2.0 - 1.0);
            let edge = 0.12 * half;
            let reach = half - edge;
            for (offset, extent) in [
                (
                    DVec3::new(a * reach, 0.0, b * reach),
                    DVec3::new(edge, half, edge),
                ),
                (
                    DVec3::new(0.0, a * reach, b * reach),
                    DVec3::new(half, edge, edge),
                ),
                (
                    DVec3::new(a * reach, b * reach, 0.0),
                    DVec3::new(edge, edge, half),
                ),
            ] {
                shape.turned_cuboid(centre + turn * offset, extent, turn);
            }
        }
    }
    for z in [9.0, 9.55] {
        shape.rod(
            DVec3::new(4.3, 0.0, z),
            DVec3::new(5.44, 4.2, z),
            [0.035, 0.03],
            8,
        );
    }
    for rung in 1..14 {
        let at = DVec3::new(4.3, 0.0, 9.0).lerp(DVec3::new(5.44, 4.2, 9.0), f64::from(rung) / 14.0);
        shape.rod(at, at + 0.55 * DVec3::Z, [0.016, 0.016], 8);
    }
    shape.finish()
}
