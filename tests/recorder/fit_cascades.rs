//! Cascades that move with a camera, with ranges that fit themselves to casters which do not move.

use glam::dcamera::rh::proj::directx::perspective_infinite_reverse;
use glam::dcamera::rh::view::look_at_mat4;
use glam::{DMat4, DVec3};
use moment_shadows::{CameraView, CascadeSplits, Cascades, LightView, Tile};

use crate::fit_range::{Map, casters};
use crate::setup::gpu;

/// Moment depth at a height above the floor, of a view from above.
fn depth(view: &LightView, height: f64) -> f64 {
    let clip = DMat4::from_cols_array_2d(&view.clip_from_world);
    2.0 * (clip * (height * DVec3::Y).extend(1.0)).z - 1.0
}

/// The casters stay where they are, and so does what is fitted to them, however the cascades' own ranges move.
#[test]
fn a_range_of_casters_that_do_not_move_stays_where_it_is() {
    let gpu = gpu();
    let cascades = Cascades {
        direction: [0.0, -1.0, 0.0],
        splits: CascadeSplits::Given(vec![6.0, 16.0]),
        near: 0.1,
        far: 40.0,
        overlap: 0.1,
        blend: 0.0,
        casters: None,
        pancaking: true,
        reversed: false,
        tile: Tile {
            texels: 512,
            filter_radius: 4.0,
        },
    };
    let maps = [0; 3].map(|_| Map::new(&gpu, 1, 1, 1));
    let mut found: [Vec<[f64; 2]>; 3] = Default::default();
    let mut moved = [0; 3];
    let mut before: Vec<LightView> = Vec::new();
    for number in 0..60 {
        let t = f64::from(number);
        let eye = DVec3::new(0.31 * t, 1.7 + 0.8 * (0.2 * t).sin(), -0.17 * t);
        let turn = DVec3::new(
            (0.09 * t).sin(),
            0.15 * (0.07 * t).sin() - 0.1,
            (0.09 * t).cos(),
        );
        let clip = perspective_infinite_reverse(1.0, 1.5, 0.1)
            * look_at_mat4(eye, eye + turn.normalize(), DVec3::Y);
        let camera = CameraView {
            clip_from_world: clip.to_cols_array_2d(),
            far_depth: 0.0,
        };
        let views = cascades.views(&camera).unwrap();
        for (index, (view, map)) in views.iter().zip(&maps).enumerate() {
            // What casts is between the floor and 0.73 above it.
            let [near, far] = [0.73, 0.0].map(|height| depth(view, height));
            assert!(-1.0 < near && far < 0.9, "{index}: {near} {far}");
            let range = map.frame(&gpu, 0, casters([near as f32, far as f32]));
            // Heights of the range's ends.
            let per_unit = (far - near) / 0.73;
            let ends = range.ends.map(|end| (far - f64::from(end)) / per_unit);
            found[index].push(ends);
            if let Some(before) = before.get(index) {
                moved[index] += i32::from((depth(before, 0.0) - far).abs() > 1e-9);
            }
        }
        before = views;
    }
    for (index, ends) in found.iter().enumerate() {
        let apart = |pair: &[[f64; 2]]| {
            let [a, b] = [pair[0], pair[1]];
            (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) / (a[0] - a[1])
        };
        let changes = ends.windows(2).map(apart);
        let largest = changes.clone().fold(0.0, f64::max);
        println!(
            "cascade {index}: its own range moves in {} of 60 frames, the fitted one changes by {largest:.1e} of its length at once",
            moved[index]
        );
        // Rounding of depth, whose range is up to 60 times as long.
        assert!(moved[index] >= 3 && largest < 1e-4, "{index}: {largest}");
    }
}
