//! Spots and the faces of a point light.

use glam::{DMat4, DVec3};
use moment_shadows::{DepthRange, LightDepth, LightView, PointLight, Tile};
use rand::RngExt as _;

use crate::{TILE, direction, place, random, within};

pub(crate) const RANGE: DepthRange = DepthRange {
    near: 0.5,
    far: 30.0,
};

pub(crate) fn lamp() -> PointLight {
    PointLight {
        position: [3.0, 2.0, -1.0],
        depth: LightDepth::Perspective {
            near: 0.1,
            far: f64::INFINITY,
            reversed: true,
            range: RANGE,
        },
        tile: TILE,
        nearest_caster: None,
    }
}

/// All ways to store depth.
fn depths() -> [LightDepth; 5] {
    let planes = |far, reversed| LightDepth::Perspective {
        near: 0.1,
        far,
        reversed,
        range: RANGE,
    };
    [
        planes(40.0, false),
        planes(40.0, true),
        planes(f64::INFINITY, false),
        planes(f64::INFINITY, true),
        LightDepth::Linear { range: RANGE },
    ]
}

/// The moment depth of stored depth, by the conversion that `resolve` applies.
fn moment_depth(view: &LightView, stored: f64) -> f64 {
    let conversion = view.depth.conversion().unwrap();
    let mixed =
        |[first, last]: [f32; 2]| f64::from(first) * (1.0 - stored) + f64::from(last) * stored;
    mixed(conversion.numerator) / mixed(conversion.denominator)
}

#[test]
fn six_faces_cover_every_direction_and_no_filter_leaves_its_face() {
    let mut random = random();
    for filter_radius in [0.0, 2.0, 7.5, 60.0] {
        let tile = Tile {
            texels: 301,
            filter_radius,
        };
        let light = PointLight { tile, ..lamp() };
        let faces = light.faces().unwrap();
        let mut closest = f64::INFINITY;
        for number in 0..20_000 {
            // Some of them towards the edges and the corners of the cube.
            let towards = match number % 4 {
                0 => direction(&mut random),
                1 => DVec3::new(1.0, 1.0, random.random_range(-1.0..1.0)),
                2 => DVec3::new(-1.0, random.random_range(-1.0..1.0), 1.0),
                _ => DVec3::new(1.0, -1.0, -1.0),
            };
            let point = DVec3::from(light.position) + 5.0 * towards;
            let looked_up = faces.iter().filter_map(|face| {
                let (texel, _) = place(face, point)?;
                // As shaders have it, who look up a sixteenth of a texel more.
                (within(face, texel) >= -1.0 / 16.0).then_some(texel)
            });
            let looked_up: Vec<_> = looked_up.collect();
            assert!(!looked_up.is_empty(), "{towards}");
            for texel in looked_up {
                // The four texels around it, and the filter around each.
                let first = (texel - 0.5).floor() - filter_radius;
                let last = (texel - 0.5).floor() + 1.0 + filter_radius;
                // Texel i is read where a filter's end lies within (i - 1, i + 1).
                let room = first.min(f64::from(tile.texels - 1) - last).min_element();
                assert!(room >= 0.0, "{towards}: {room}");
                closest = closest.min(room);
            }
        }
        // No wider than it has to be.
        assert!(closest < 1.0, "{closest}");
    }
}

/// Casters at the refused distance and a little farther away, wherever a face shows them: the first may lie in front of where the face
/// begins, the second does not.
#[test]
fn no_face_begins_behind_the_nearest_caster() {
    let mut random = random();
    for depth in depths() {
        let with = |distance| PointLight {
            depth,
            nearest_caster: Some(distance),
            ..lamp()
        };
        // Where the corner of a face, its guard band included, is that far away as the range begins.
        let inner = f64::from(TILE.texels - 2 * TILE.guard().unwrap()) / f64::from(TILE.texels);
        let corner = RANGE.near * (1.0 + 2.0 / (inner * inner)).sqrt();
        let refused = with(0.999 * corner).faces().unwrap_err();
        assert_eq!(refused.name, "nearest_caster");
        assert!(refused.message.contains("begins at 0.5"), "{refused}");
        let light = with(1.001 * corner);
        let faces = light.faces().unwrap();
        let nearest = (0..20_000).filter_map(|_| {
            let distance = 1.001 * corner;
            let point = DVec3::from(light.position) + distance * direction(&mut random);
            let shown = faces.iter().filter(|face| {
                let found = place(face, point);
                found.is_some_and(|(texel, _)| within(face, texel) >= -f64::from(face.guard))
            });
            let along = shown.map(|face| {
                let clip = DMat4::from_cols_array_2d(&face.clip_from_world);
                clip.row(3).dot(point.extend(1.0))
            });
            along.reduce(f64::min)
        });
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        assert!((1.0..1.03).contains(&(nearest / RANGE.near)), "{nearest}");
        // A narrow spot needs less room.
        light.spot([1.0, 2.0, 3.0], 0.1).unwrap();
        with(0.51).spot([1.0, 2.0, 3.0], 0.1).unwrap();
    }
}

#[test]
fn the_major_axis_is_the_face() {
    let mut random = random();
    let light = lamp();
    let faces = light.faces().unwrap();
    for _ in 0..1000 {
        let towards = direction(&mut random);
        let axis = towards.abs().max_position();
        let chosen = 2 * axis + usize::from(towards[axis] < 0.0);
        let point = DVec3::from(light.position) + 4.0 * towards;
        for (index, face) in faces.iter().enumerate() {
            let inside = place(face, point).is_some_and(|(texel, _)| within(face, texel) > 1e-9);
            assert_eq!(inside, index == chosen, "{towards} {index}");
        }
    }
}

#[test]
fn depth_is_stored_as_the_light_says() {
    let mut random = random();
    for depth in depths() {
        let light = PointLight { depth, ..lamp() };
        let spot = light.spot([1.0, -2.0, 0.5], 1.2).unwrap();
        let faces = light.faces().unwrap();
        for view in faces.iter().chain([&spot]) {
            assert_eq!((view.depth, view.range()), (depth, RANGE));
            let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
            let reversed = matches!(depth, LightDepth::Perspective { reversed: true, .. });
            // Its sign is that of a camera's projection, which mirrors nothing.
            assert!(
                clip.determinant() * if reversed { 1.0 } else { -1.0 } > 0.0,
                "{depth:?}"
            );
            for _ in 0..50 {
                let point = DVec3::from(light.position) + 8.0 * direction(&mut random);
                let Some((_, stored)) = place(view, point) else {
                    continue;
                };
                let distance = clip.row(3).dot(point.extend(1.0));
                let expected = (2.0 * distance - RANGE.near - RANGE.far) / (RANGE.far - RANGE.near);
                if matches!(depth, LightDepth::Linear { .. }) {
                    let [near, far] = [RANGE.near, RANGE.far];
                    let hyperbolic = far / (far - near) * (1.0 - near / distance);
                    assert!((stored - hyperbolic).abs() < 1e-9);
                } else if distance > 0.1 {
                    // The conversion's numbers are f32; beside an infinite plane they lose the ratio of the planes' digits.
                    let found = moment_depth(view, stored);
                    assert!(
                        (found - expected).abs() < 1e-4,
                        "{depth:?}: {found} {expected}"
                    );
                }
            }
        }
    }
}

#[test]
fn a_cone_lies_in_the_square_of_its_spot() {
    let light = lamp();
    let axis = DVec3::new(1.0, -2.0, 0.5).normalize();
    let (side, angle) = (axis.any_orthonormal_vector(), 2.3_f64);
    let spot = light.spot((3.0 * axis).to_array(), angle).unwrap();
    let mut least = f64::INFINITY;
    for step in 0..360 {
        let around = side * f64::from(step).to_radians().cos()
            + axis.cross(side) * f64::from(step).to_radians().sin();
        let ray = axis * (0.5 * angle).cos() + around * (0.5 * angle).sin();
        let (texel, _) = place(&spot, DVec3::from(light.position) + 7.0 * ray).unwrap();
        assert!(within(&spot, texel) > -1e-9);
        least = least.min(within(&spot, texel));
    }
    assert!(least < 0.1, "the cone leaves {least} texels");
}
