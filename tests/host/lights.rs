//! Lights and viewpoints.

use glam::{DVec2, DVec3};
use moment_shadows_lab::light::{DirectionalFit, LightView};
use moment_shadows_lab::scene::{self, Scene};
use moment_shadows_lab::view::View;

/// A spot light of every way to store depth, and the sun of a viewpoint both ways.
fn lights(scene: &Scene, view: &View) -> Vec<LightView> {
    let mut lights = Vec::new();
    for reversed in [false, true] {
        lights.push(view.sun(scene, [512, 256], 8.0, reversed).unwrap());
        for far in [Some(40.0), None] {
            lights.push(view.spot(scene, 0.1, far, reversed).unwrap());
        }
    }
    lights
}

#[test]
fn a_fitted_sun_covers_all_casters_and_leaves_its_margin() {
    let map = [1024, 512];
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        for number in 0..6 {
            let view = View::numbered(&scene, number);
            let sun = view.sun(&scene, map, 12.0, false).unwrap();
            let margin = DVec2::new(12.0 / 1024.0, 12.0 / 512.0);
            let mut low = DVec2::ONE;
            let mut high = DVec2::ZERO;
            for point in scene.casters() {
                let uv = sun.uv(point).unwrap();
                low = low.min(uv);
                high = high.max(uv);
                assert!(
                    sun.moment_depth(point).abs() <= 1.0,
                    "{name} {number}: {point}"
                );
            }
            // Tight: the outermost casters touch the margin, up to rounding in f64.
            assert!(
                (low - margin).abs().max_element() < 1e-9,
                "{name} {number}: {low}"
            );
            assert!(
                (1.0 - high - margin).abs().max_element() < 1e-9,
                "{name} {number}: {high}"
            );
            // In depth they leave 1/1000 before the first and 1/16 behind the last, of the casters' depth.
            let [mut nearest, mut farthest] = [1.0f64, -1.0f64];
            for depth in scene.casters().map(|point| sun.moment_depth(point)) {
                nearest = nearest.min(depth);
                farthest = farthest.max(depth);
            }
            let casters = farthest - nearest;
            assert!(
                (nearest + 1.0 - 1e-3 * casters).abs() < 1e-9
                    && (1.0 - farthest - casters / 16.0).abs() < 1e-9,
                "{name} {number}: {nearest} {farthest}"
            );
        }
    }
}

#[test]
fn uv_rays_and_stored_depth_agree_with_the_clip_matrices() {
    let scene = scene::load("hall").unwrap();
    for light in lights(&scene, &View::numbered(&scene, 1)) {
        for uv in [[0.5, 0.5], [0.1, 0.3], [0.95, 0.9]].map(DVec2::from_array) {
            for part in [0.001, 0.3, 0.999] {
                let distance = light.range[0] + part * (light.range[1] - light.range[0]);
                let (origin, direction) = light.ray(uv);
                let point = origin + distance * direction;
                // Lengths are some 100 m in f64, so 1e-9 is generous for rounding.
                assert!((light.distance(point) - distance).abs() < 1e-9);
                assert!((light.uv(point).unwrap() - uv).length() < 1e-9);
                let depth = light.moment_depth(point);
                assert!((depth - (2.0 * part - 1.0)).abs() < 1e-9);
                let clip = light.clip_from_world() * point.extend(1.0);
                let stored = clip.z / clip.w;
                // Hyperbolic depth loses up to far/near digits when it is inverted.
                let error = (light.moment_depth_of_stored(stored) - depth).abs();
                assert!(error < 1e-8, "{:?}: {error}", light.depth);
            }
        }
        assert_eq!(light.moment_depth_of_stored(f64::NAN), 1.0);
        assert_eq!(light.moment_depth_of_stored(light.depth.cleared()), 1.0);
        let near = if light.depth.reversed() { 7.0 } else { -7.0 };
        assert_eq!(light.moment_depth_of_stored(near), -1.0);
        let axis = light.towards_light(DVec3::ZERO);
        let behind = light.ray(DVec2::splat(0.5)).0 + 200.0 * axis;
        assert_eq!(light.uv(behind).is_none(), light.range[0] > 0.0);
    }
}

#[test]
fn lights_that_cannot_be_are_refused() {
    let fit = DirectionalFit {
        map: [64, 64],
        margin: 4.0,
        reversed: false,
    };
    let points = [DVec3::ZERO, DVec3::ONE];
    let sun = LightView::directional_fitted;
    let spot = |angle, near, far, range| {
        LightView::spot(DVec3::Y, DVec3::NEG_Y, angle, near, far, range, false)
    };
    let rows = [
        (sun(DVec3::ZERO, &points, fit), "direction [0, 0, 0]"),
        (sun(DVec3::NAN, &points, fit), "direction [NaN"),
        (sun(DVec3::NEG_Y, &[], fit), "no casters"),
        (
            sun(DVec3::NEG_Y, &[DVec3::ZERO, DVec3::INFINITY], fit),
            "fitted: point 1 is [inf",
        ),
        (
            sun(
                DVec3::NEG_Y,
                &points,
                DirectionalFit {
                    margin: 32.0,
                    ..fit
                },
            ),
            "64x64 texels has no room for a margin of 32",
        ),
        (spot(0.0, 0.1, None, [0.1, 1.0]), "full angle of 0 radians"),
        (spot(3.2, 0.1, None, [0.1, 1.0]), "full angle of 3.2"),
        (
            spot(1.0, 0.0, None, [0.1, 1.0]),
            "depth planes reaches from 0 ",
        ),
        (
            spot(1.0, 2.0, Some(1.0), [0.1, 1.0]),
            "depth planes reaches from 2 to 1",
        ),
        (
            spot(1.0, f64::NAN, Some(1.0), [0.1, 1.0]),
            "depth planes reaches from NaN",
        ),
        (spot(1.0, 0.1, None, [0.1, f64::INFINITY]), "moment range"),
    ];
    for (result, culprit) in rows {
        let error = result.unwrap_err();
        assert!(
            error.to_string().contains(culprit),
            "'{error}' lacks '{culprit}'"
        );
    }
    // Degenerate but possible: one point, and straight down.
    let light = sun(DVec3::NEG_Y, &points[..1], fit).unwrap();
    assert!((light.uv(DVec3::ZERO).unwrap() - 0.5).length() < 1e-9);
    assert!(light.moment_depth(DVec3::ZERO).abs() <= 1.0);
}

#[test]
fn viewpoints_are_numbered() {
    let scene = scene::load("fence-and-foliage").unwrap();
    let views: Vec<View> = (0..8)
        .map(|number| View::numbered(&scene, number))
        .collect();
    for (number, view) in (0..8).zip(&views) {
        assert_eq!(*view, View::numbered(&scene, number));
        assert!(views.iter().filter(|other| *other == view).count() == 1);
        assert!(view.light_direction.is_normalized());
    }
    // A low sun: 25 to 30 degrees.
    let elevation = (-views[0].light_direction.y).asin().to_degrees();
    assert!((25.0..30.0).contains(&elevation), "{elevation}");
}
