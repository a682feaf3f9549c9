//! The procedural scenes against brute force, and beside the exact bound.
//!
//! A picture's error has three parts: what four moments cannot tell (the exact bound's error), what the moment bias
//! blurs (the error of the bound of biased moments, less that), and rounding (the rest).

use moment_shadows::Storage;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::{LightChoice, RenderOptions, profile_for};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::GraphFrame;
use moment_shadows_lab::judgement::Truth;
use moment_shadows_lab::scene;

use crate::stage::{StageDesc, mean_difference};

/// What is held of a storage.
struct Limits {
    storage: Storage,
    /// The mean difference to the bound of biased moments in f64: rounding of every kind, of the shader's arithmetic and
    /// of a resolve and two blurs to the storage. The bias is so large that no pixel is lost to it; in the mean it should
    /// not show in a picture of 8 bits.
    rounding: f64,
    /// How much rounding may add to the error of that bound, relative to it. Rounding goes either way.
    excess_of_rounding: f64,
    /// How much more error than the exact bound's there may be with a sun whose range is as tight as the scene allows.
    /// Both scenes are full of contact, where a moment bias costs most: within its leak distance of a fence's foot, the
    /// exact bound of unbiased moments still tells two surfaces apart. So this part is the bias's, not the shader's.
    excess: f64,
    /// The mean error.
    error: f64,
}

const LIMITS: [Limits; 3] = [
    Limits {
        storage: Storage::Unorm16,
        rounding: 1.0 / 255.0,
        excess_of_rounding: 0.01,
        excess: 0.55,
        error: 0.055,
    },
    Limits {
        storage: Storage::Float16,
        rounding: 1.0 / 255.0,
        excess_of_rounding: 0.01,
        excess: 1.4,
        error: 0.07,
    },
    Limits {
        storage: Storage::Float32,
        rounding: 1e-4,
        excess_of_rounding: 1.0 / 255.0,
        excess: 0.15,
        error: 0.05,
    },
];

fn check(name: &str, light: LightChoice) {
    let scene = scene::load(name).unwrap();
    let options = RenderOptions {
        scene: name.to_owned(),
        light,
        ..RenderOptions::default()
    };
    let drawn = Drawn {
        picture: [320, 180],
        map: [512; 2],
        ..Drawn::default()
    };
    let mut truth = None;
    for limits in LIMITS {
        let storage = limits.storage;
        let file = StageDesc {
            picture: drawn.picture,
            map: drawn.map[0],
            ..StageDesc::new(storage)
        }
        .graph();
        let gpu = Gpu::open(profile_for(Some(storage), drawn.samples)).unwrap();
        let frame = options.frame(&gpu, &scene, &drawn, 4).unwrap();
        let graph = GraphFrame::new(&gpu, &frame, &file).unwrap();
        graph.run(&gpu).unwrap();
        let shadow = graph.read_shadow(&gpu, &file).unwrap();
        let truth = &*truth.get_or_insert_with(|| Truth::of(&gpu, &frame, &file).unwrap());
        let biased = truth.biased_bound(storage);
        let [found, of_biased] = [&shadow, &biased].map(|picture| truth.judge(picture).unwrap());
        let rounding = mean_difference(&shadow, &biased);
        let error = found.error.facing.mean_absolute;
        let excess = found.excess.error.unwrap();
        let excess_of_rounding = error / of_biased.error.facing.mean_absolute - 1.0;
        println!(
            "{name} {light:?} {storage}: error {error:.5} (bound's own {:.5}), excess {:+.1} %, of it by rounding {:+.2} %, \
             mean rounding {rounding:.6}",
            truth.bound_error.facing.mean_absolute,
            100.0 * excess,
            100.0 * excess_of_rounding,
        );
        assert_eq!(found.error.nan_pixels, 0, "{name} {light:?} {storage}");
        // Enough of the picture is in half shadow for the figures to mean something.
        assert!(found.error.penumbra.samples > 3000, "{name} {light:?}");
        assert!(
            rounding < limits.rounding,
            "{name} {light:?} {storage}: {rounding}"
        );
        assert!(
            excess_of_rounding < limits.excess_of_rounding,
            "{name} {light:?} {storage}: {excess_of_rounding}"
        );
        assert!(
            excess < limits.excess,
            "{name} {light:?} {storage}: {excess}"
        );
        assert!(error < limits.error, "{name} {light:?} {storage}: {error}");
    }
}

#[test]
fn a_fence_and_foliage_in_the_sun() {
    check("fence-and-foliage", LightChoice::Sun);
}

#[test]
fn a_fence_and_foliage_in_a_spot_light() {
    check("fence-and-foliage", LightChoice::Spot);
}

#[test]
fn a_hall_in_the_sun() {
    check("hall", LightChoice::Sun);
}

#[test]
fn a_hall_in_a_spot_light() {
    check("hall", LightChoice::Spot);
}
