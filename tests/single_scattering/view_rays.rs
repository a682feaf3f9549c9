//! Which view rays a picture has, by brute force over its pixels, and what that makes of lit ground.

use bytemuck::bytes_of;
use glam::{DVec3, DVec4};
use moment_shadows::{MapEncoding, RectifiedView, ScatteringParameters, Storage, Technique};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::cameras::Pair;
use crate::pictures::{
    FAR, MAP, PICTURE, Sun, camera, camera_view, directions, graph_of, medium, seen,
};
use crate::stage::{capabilities, depths, gpu, run, upload};

/// Columns and rows.
const EXTENT: [usize; 2] = [70, 36];

/// Rows to either side whose view rays a texel knows.
const ROWS: f64 = 4.0;

/// A pixel's view ray: how many columns it passes, its row, and its inclination.
struct Ray {
    columns: f64,
    row: f64,
    inclination: f64,
}

/// The distance along the camera's axis of a stored depth, of a near plane at 0.1 and none far away; what is farther than the air
/// is at its end.
fn distance(stored: u16) -> f64 {
    (0.1 * 65535.0 / f64::from(stored).max(1e-9)).min(FAR)
}

fn rays(pair: &Pair, view: &RectifiedView, stored: &[u16]) -> Vec<Ray> {
    let eye = DVec3::from_array(view.camera);
    let along = |x: f64, y: f64| {
        let point = pair.world_from_clip * DVec4::new(x, y, 1.0, 1.0);
        point.truncate() / point.w - eye
    };
    let axis = along(0.0, 0.0).normalize();
    let axes = view.axes.map(DVec3::from_array);
    let frame = view.frame;
    let [columns, rows] = EXTENT.map(|side| side as f64);
    (stored.iter().enumerate())
        .map(|(index, &stored)| {
            let [x, y] = [index as u32 % PICTURE[0], index as u32 / PICTURE[0]];
            let place = |place: u32, size: u32| (2.0 * f64::from(place) + 1.0) / f64::from(size);
            let ray = along(place(x, PICTURE[0]) - 1.0, 1.0 - place(y, PICTURE[1]));
            let end = ray * (distance(stored) / ray.dot(axis));
            let [first, second, third] = axes.map(|axis| axis.dot(end));
            let radius = first.hypot(second);
            let turned = (second.atan2(first) - f64::from(frame.first_azimuth))
                .rem_euclid(core::f64::consts::TAU);
            Ray {
                columns: radius / f64::from(frame.largest_radius) * columns,
                row: turned / f64::from(frame.azimuth_extent) * (rows - 1.0),
                inclination: radius.atan2(third),
            }
        })
        .collect()
}

/// The least and the greatest of some numbers.
fn ends(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], it| {
        [low.min(it), high.max(it)]
    })
}

#[test]
fn texels_know_the_view_rays_that_pass_and_end() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let map = upload(&gpu, &encoding, [MAP; 2], &sun.moments());
    let graph = seen(&graph_of(
        EXTENT.map(|it| it as u32),
        "\"hamburger6\"",
        "float16",
    ))
    .replace(
        r#""name": "scattering", "from": "composite.scattering""#,
        r#""name": "view_rays", "from": "rectify.view_rays""#,
    );
    let mut random = ChaCha8Rng::seed_from_u64(20);
    let (mut known, mut unknown, mut sines) = (0, 0, 0);
    for (name, forward) in directions(&sun) {
        let pair = camera(forward);
        let parameters =
            ScatteringParameters::new(&camera_view(&pair), FAR, &sun.view(), medium(1.0)).unwrap();
        let view = RectifiedView::new(&pair.clip_from_world, FAR, sun.direction().to_array());
        let view = view.unwrap();
        // Smooth surfaces, single pixels, and sky.
        let stored: Vec<u16> = (0..PICTURE[0] * PICTURE[1])
            .map(|index| match random.random_range(0..8) {
                0 => 0,
                1 => random.random_range(200..6000),
                _ => (400 + 40 * (index % PICTURE[0])) as u16,
            })
            .collect();
        let layers = run(
            &gpu,
            &capabilities(&gpu),
            &graph,
            &[
                ("map", &map),
                ("camera_depth", &depths(&gpu, PICTURE, &stored)),
            ],
            &[("rectify", bytes_of(&parameters.rectify))],
            "view_rays",
        );
        let found: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&layers[0]);
        let rays = rays(&pair, &view, &stored);
        let [smallest, largest] = [
            view.frame.smallest_inclination,
            view.frame.largest_inclination,
        ]
        .map(f64::from);
        let depth = |ray: &Ray| 1.0 - 2.0 * (ray.inclination - smallest) / (largest - smallest);
        for (index, [bounds, sine]) in found.into_iter().enumerate() {
            let [column, row] = [index % EXTENT[0], index / EXTENT[0]].map(|it| it as f64);
            let [low, high] =
                [bounds & 0xffff, bounds >> 16].map(|steps| f64::from(steps) / 65535.0 * 2.0 - 1.0);
            // View rays for sure, and those that rounding may add. One that passes no column whole counts in the first.
            let passing = |slack: f64| {
                let rays = rays.iter().filter(move |ray| {
                    let last = (ray.columns - 1.0).max(0.0);
                    (ray.row - row).abs() < 1.0 + ROWS + slack && last >= column - slack
                });
                ends(rays.map(depth))
            };
            let [sure, most] = [passing(-1e-4), passing(1e-4)];
            if most[0] > most[1] {
                assert_eq!([bounds, sine], [0xffff_0000, 0], "{name} {column} {row}");
                unknown += 1;
                continue;
            }
            known += 1;
            assert!(
                low <= sure[0] && high >= sure[1],
                "{name} {column} {row}: {low} to {high}, not {sure:?}"
            );
            // Two steps and what f32 rounds.
            assert!(
                low >= (most[0] - 7e-5).max(-1.0) && high <= (most[1] + 7e-5).min(1.0),
                "{name} {column} {row}: {low} to {high}, not {most:?}"
            );
            let ending = |slack: f64| {
                let rays = rays.iter().filter(move |ray| {
                    let last = (ray.columns - 1.0).max(0.0);
                    (ray.row - row).abs() < 1.0 + slack
                        && last >= column - 1.0 - slack
                        && last < column + 2.0 + slack
                });
                ends(rays.map(|ray| ray.inclination))
            };
            let [sure, most] = [ending(-1e-4), ending(1e-4)];
            if sure == most && sure[0] <= sure[1] {
                let expected = 0.5 * (sure[0].sin() + sure[1].sin());
                let error = f64::from(f32::from_bits(sine)) - expected;
                assert!(error.abs() < 1e-5, "{name} {column} {row}: {error}");
                sines += 1;
            }
        }
    }
    println!("{known} known, {unknown} unknown, {sines} sines");
    assert!(known > 1500 && unknown > 100 && sines > 1000);
}

#[test]
fn lit_ground_does_not_darken_the_air_before_it() {
    let gpu = gpu();
    let sun = Sun::new(DVec3::new(0.5, -1.0, 0.3));
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    // Nothing but a ground, 1.5 units below the camera.
    let ground = 0.2;
    let moments = sun.moments_of(|near| Some((ground - near.y) / sun.direction().y));
    let map = upload(&gpu, &encoding, [MAP; 2], &moments);
    let empty = upload(
        &gpu,
        &encoding,
        [MAP; 2],
        &vec![[1.0; 4]; (MAP * MAP) as usize],
    );
    let all = graph_of([256, 256], "\"hamburger6\"", "float16");
    // The mean share of light that is lost, and the largest.
    let mut lost = [[0.0_f64; 2]; 2];
    for forward in [
        DVec3::new(1.0, -0.5, 0.2),
        DVec3::new(-0.8, -0.7, 0.5),
        DVec3::new(0.2, -0.4, -1.0),
    ] {
        let pair = camera(forward);
        let view = RectifiedView::new(&pair.clip_from_world, FAR, sun.direction().to_array());
        let eye = DVec3::from_array(view.unwrap().camera);
        let along = |x: f64, y: f64| {
            let point = pair.world_from_clip * DVec4::new(x, y, 1.0, 1.0);
            point.truncate() / point.w - eye
        };
        let axis = along(0.0, 0.0).normalize();
        let stored: Vec<u16> = (0..PICTURE[0] * PICTURE[1])
            .map(|index| {
                let [x, y] = [index % PICTURE[0], index / PICTURE[0]];
                let place =
                    |place: u32, size: u32| (2.0 * f64::from(place) + 1.0) / f64::from(size);
                let ray = along(place(x, PICTURE[0]) - 1.0, 1.0 - place(y, PICTURE[1]));
                // The stored depth is at least that of the ground: surfaces lie on it or a little before it.
                let distance = (ground - eye.y) / ray.y * ray.dot(axis);
                if distance > 0.0 {
                    (0.1 / distance * 65535.0).ceil().min(65535.0) as u16
                } else {
                    0
                }
            })
            .collect();
        let camera_depth = depths(&gpu, PICTURE, &stored);
        let parameters =
            ScatteringParameters::new(&camera_view(&pair), FAR, &sun.view(), medium(1.0)).unwrap();
        let picture = |graph: &str, map| -> Vec<[f32; 4]> {
            let layers = run(
                &gpu,
                &capabilities(&gpu),
                graph,
                &[("map", map), ("camera_depth", &camera_depth)],
                &[
                    ("rectify", bytes_of(&parameters.rectify)),
                    ("integrate", bytes_of(&parameters.integrate)),
                    ("composite", bytes_of(&parameters.composite)),
                ],
                "scattering",
            );
            bytemuck::pod_collect_to_vec(&layers[0])
        };
        let lit = picture(&all, &empty);
        for (graph, lost) in [&all, &seen(&all)].into_iter().zip(&mut lost) {
            for (found, lit) in picture(graph, &map).into_iter().zip(&lit) {
                let share = 1.0 - f64::from(found[0]) / f64::from(lit[0]);
                lost[0] += share / (3.0 * stored.len() as f64);
                lost[1] = lost[1].max(share);
            }
        }
    }
    println!("lost: {lost:?}");
    assert!(lost[0][0] > 0.01, "the scene shows nothing: {lost:?}");
    // What is left is that the filter of a coarse map takes slanted ground for two surfaces.
    assert!(
        lost[1][0] < 0.15 * lost[0][0] && lost[1][1] < 0.025,
        "{lost:?}"
    );
}
