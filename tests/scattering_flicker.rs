//! What flickers in the air, and how that is measured.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::scattering::{
    Change, FRAMES, FlickerDesc, GOAL, PROFILE, Path, Place, STILL, chains, flicker, static_region,
};
use moment_shadows_lab::scene;

#[test]
fn a_pixel_is_static_while_its_truth_and_that_of_frames_around_is() {
    // Three pixels: calm, with a jump between frames 2 and 3, and creeping.
    let truth: Vec<Vec<f32>> = (0..8)
        .map(|frame| {
            let jump = if frame > 2 { 1.0 } else { 0.0 };
            vec![0.5, jump, 0.25 * frame as f32]
        })
        .collect();
    let of = |still, window| {
        let pixel = |region: &[Vec<bool>], pixel: usize| -> String {
            let frames = region.iter().map(|frame| frame[pixel]);
            frames
                .map(|is_static| if is_static { 's' } else { '.' })
                .collect()
        };
        let region = static_region([&truth, &truth], still, window);
        [0, 1, 2].map(|index| pixel(&region, index))
    };
    assert_eq!(of(0.1, 0), ["sssssss", "ss.ssss", "......."]);
    assert_eq!(of(0.1, 1), ["sssssss", "s...sss", "......."]);
    assert_eq!(of(0.1, 2), ["sssssss", ".....ss", "......."]);
    assert_eq!(of(0.25, 0), ["sssssss", "ss.ssss", "sssssss"]);
    // Where a ray ends elsewhere that is as bright.
    let even = vec![vec![0.5; 3]; 8];
    for truths in [[&truth[..], &even], [&even, &truth]] {
        let region = static_region(truths, 0.1, 0);
        assert_eq!(region[2], [true, false, false]);
    }
}

#[test]
fn changes_are_those_of_the_region_alone() {
    let truth = vec![vec![0.0, 0.0], vec![0.125, 9.0], vec![0.25, 9.0]];
    let frames = vec![vec![0.0, 1.0], vec![0.25, 5.0], vec![0.125, 5.5]];
    let region = vec![vec![true, false], vec![true, true]];
    let change = Change::of(&frames, &truth, &region);
    // 0.25 and -0.125 of the first pixel, 0.5 of the second.
    assert_eq!(change.largest, 0.5);
    assert_eq!(change.largest_less_truth, 0.5);
    assert_eq!(change.at, Some(Place { frame: 1, pixel: 1 }));
    assert!((change.mean - 0.875 / 3.0).abs() < 1e-12);
    let broken = vec![vec![0.0, 1.0], vec![f32::NAN, 5.0], vec![0.125, 5.5]];
    assert_eq!(Change::of(&broken, &truth, &region).largest, f64::INFINITY);
    assert_eq!(Change::of(&frames, &truth, &[]), Change::default());
}

#[test]
fn a_path_is_slow_and_closed() {
    let scene = scene::load("hall").unwrap();
    let path = Path::new(&scene);
    let radius = scene.bounds().radius();
    let (first, last) = (path.view(0), path.view(FRAMES));
    assert!((first.camera.eye - last.camera.eye).length() < 1e-9 * radius);
    let mut moved: f64 = 0.0;
    for frame in 0..FRAMES {
        let [one, next] = [path.view(frame), path.view(frame + 1)];
        let step = (one.camera.eye - next.camera.eye).length() / radius;
        let turn = one.light_direction.angle_between(next.light_direction);
        assert!(step < 5e-4 && turn < 3e-4, "{frame}: {step}, {turn}");
        moved += step;
    }
    assert!(moved > 0.03, "{moved}");
}

#[test]
fn the_chains_differ_in_their_filters_alone() {
    let [filtered, seen, unfiltered] = chains([64, 32]).unwrap();
    assert_eq!(seen.text.matches("view_rays").count(), 2);
    for (text, is_filtered) in [
        (filtered.text, true),
        (seen.text, true),
        (unfiltered.text, false),
    ] {
        let has = |node: &str| text.contains(&format!("\"{node}\""));
        assert_eq!(has("blur"), is_filtered, "{text}");
        assert_eq!(has("rectify_nearest"), !is_filtered);
        assert!(has("integrate_scattering") && has("composite_scattering"));
        assert!(!has("shade_hard") && has("hamburger6"));
    }
}

#[test]
fn filtered_resampling_flickers_a_third_as_much_as_none() {
    let gpu = Gpu::open(PROFILE).unwrap();
    let scene = scene::load("hall").unwrap();
    let desc = FlickerDesc {
        frames: 8,
        map: 512,
        columns: 256,
        rows: 256,
        width: 128,
        height: 72,
        truth_map: 1024,
        steps: 256,
    };
    let mut frames = 0;
    let found = flicker(&gpu, &scene, &desc, || frames += 1).unwrap();
    println!("{found}");
    assert_eq!(frames, 8);
    // There is a region to speak of, and its truth is static.
    assert!(found.region > 0.1, "{found}");
    assert!(found.truth.largest <= f64::from(STILL) * 1.001, "{found}");
    assert!(found.ratio() <= GOAL, "{found}");
    // Two frames and the change, of four series.
    assert_eq!(found.pictures.len(), 12);
    assert!(found.pictures.iter().all(|it| it.len() == 128 * 72 * 4));
    assert_ne!(found.pictures[6], found.pictures[7]);
}
