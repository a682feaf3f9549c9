//! Whichever way a light's depth is stored, the picture is the same.

use moment_shadows::Storage;
use moment_shadows_lab::light::LightView;
use moment_shadows_lab::scene;
use moment_shadows_lab::view::View;

use crate::stage::{Stage, StageDesc, camera_for, mean_difference};

/// What one step of an 8-bit picture is.
const STEP: f64 = 1.0 / 255.0;

fn desc(reversed: bool) -> StageDesc {
    StageDesc {
        picture: [192, 108],
        map: 256,
        reversed,
        ..StageDesc::new(Storage::Float32)
    }
}

/// The pictures of fence and foliage under a light stored forward and reversed.
fn pictures(lights: impl Fn(&View, &scene::Scene, bool) -> Vec<LightView>) -> Vec<Vec<f32>> {
    let scene = scene::load("fence-and-foliage").unwrap();
    let view = View::numbered(&scene, 0);
    [false, true]
        .into_iter()
        .flat_map(|reversed| {
            let stage = Stage::new(desc(reversed));
            let model = stage.upload(&scene);
            let camera = camera_for(&view, &stage.desc);
            lights(&view, &scene, reversed)
                .into_iter()
                .map(|light| stage.shadow(&model, &light, &camera))
                .collect::<Vec<_>>()
        })
        .collect()
}

/// Enough of the picture lies in shadow, and enough does not, for a difference to be seen.
fn assert_tells(picture: &[f32]) {
    let mean = picture.iter().map(|&value| f64::from(value)).sum::<f64>() / picture.len() as f64;
    assert!(mean > 0.05 && mean < 0.6, "{mean}");
}

#[test]
fn forward_and_reversed_suns_give_the_same_picture() {
    let pictures =
        pictures(|view, scene, reversed| vec![view.sun(scene, [256, 256], 6.0, reversed).unwrap()]);
    assert_tells(&pictures[0]);
    let difference = mean_difference(&pictures[0], &pictures[1]);
    println!("sun, reversed: {difference:.6}");
    assert!(difference < STEP, "{difference}");
}

#[test]
fn all_ways_to_store_a_spot_lights_depth_give_the_same_picture() {
    let pictures = pictures(|view, scene, reversed| {
        [Some(4.0), None]
            .map(|far| view.spot(scene, 0.05, far, reversed).unwrap())
            .to_vec()
    });
    assert_tells(&pictures[0]);
    for (picture, name) in pictures.iter().zip([
        "forward, finite",
        "forward, infinite",
        "reversed, finite",
        "reversed, infinite",
    ]) {
        let difference = mean_difference(&pictures[0], picture);
        println!("spot, {name}: {difference:.6}");
        assert!(difference < STEP, "{name}: {difference}");
    }
}

#[test]
fn a_near_plane_at_a_hundred_thousandth_of_the_far_one_costs_reversed_depth_nothing() {
    // The casters begin at 0.66 of the light's distance: a near plane just before them loses no digits either way.
    let pictures = pictures(|view, scene, reversed| {
        [0.5, 4e-5]
            .map(|near| view.spot(scene, near, Some(4.0), reversed).unwrap())
            .to_vec()
    });
    let [ideal, forward, ideal_reversed, reversed] = &pictures[..] else {
        panic!("{} pictures", pictures.len());
    };
    assert_tells(ideal);
    assert!(mean_difference(ideal, ideal_reversed) < 0.1 * STEP);
    let [forward, reversed] =
        [forward, reversed].map(|picture| mean_difference(ideal_reversed, picture));
    println!("near/far 1e-5: mean difference reversed {reversed:.6}, forward {forward:.6}");
    assert!(reversed < STEP, "{reversed}");
    // Forward float depth has steps of 2^-24 / near = 0.15 % of the distance left, some 0.4 % of the casters' range: the
    // comparison above is one that can fail.
    assert!(forward > 20.0 * reversed, "{forward}");
}
