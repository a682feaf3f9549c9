//! Cameras and lights without rectified coordinates are refused by name.

use glam::{DMat3, DMat4, DVec3};
use moment_shadows::{RectifiedView, ValueError};

use crate::cameras::{Lens, pair};

fn camera() -> [[f64; 4]; 4] {
    let lens = Lens {
        field_of_view: 1.0,
        aspect: 1.5,
        near: 0.1,
        far: None,
    };
    pair(DVec3::ONE, DMat3::IDENTITY, lens, 1.0, DVec3::X).clip_from_world
}

fn error(camera: [[f64; 4]; 4], far: f64, light: [f64; 3]) -> ValueError {
    RectifiedView::new(&camera, far, light).unwrap_err()
}

#[test]
fn a_singular_camera_is_refused() {
    for broken in [
        [[0.0; 4]; 4],
        [[f64::NAN; 4]; 4],
        [[1.0; 4]; 4],
        [[f64::INFINITY, 0.0, 0.0, 0.0]; 4],
    ] {
        let found = error(broken, 10.0, [0.0, -1.0, 0.0]);
        assert_eq!(found.name, "camera");
        assert!(found.message.contains("is singular or not finite"));
    }
}

#[test]
fn an_orthographic_camera_is_refused() {
    let orthographic = DMat4::from_scale_rotation_translation(
        DVec3::new(0.1, 0.2, 0.01),
        glam::DQuat::from_rotation_y(0.4),
        DVec3::new(0.3, 0.1, 0.5),
    );
    let found = error(orthographic.to_cols_array_2d(), 10.0, [0.0, -1.0, 0.0]);
    assert_eq!(found.name, "camera");
    assert!(found.to_string().contains("orthographic"));
}

#[test]
fn a_frustum_without_length_is_refused() {
    for far in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let found = error(camera(), far, [0.0, -1.0, 0.0]);
        assert_eq!(found.name, "far", "{found}");
    }
    let found = error(camera(), 1e300, [0.0, -1.0, 0.0]);
    assert_eq!(found.name, "frustum", "{found}");
}

#[test]
fn a_light_without_direction_is_refused() {
    for light in [[0.0; 3], [f64::NAN, 0.0, 1.0], [f64::INFINITY, 0.0, 0.0]] {
        let found = error(camera(), 10.0, light);
        assert_eq!(found.name, "light_direction", "{found}");
    }
}

#[test]
fn the_length_of_the_direction_does_not_matter() {
    let frames = [1e-200, 1.0, 1e200].map(|scale| {
        let light = [0.3 * scale, -scale, 0.2 * scale];
        RectifiedView::new(&camera(), 10.0, light).unwrap().frame
    });
    for frame in frames {
        assert!((frame.largest_inclination - frames[0].largest_inclination).abs() < 1e-6);
    }
}
