//! Filtered shadows beside Bevy's own, and beside none.

mod common;

use bevy::prelude::*;
use common::{SIZE, brightness, difference, drawn, filtered, keep, pictures, truth};
use moment_shadows_bevy::demo::{Look, Stage, sun};

/// Techniques and storages, and the most that their picture may differ from percentage-closer filtering with the same kernel.
const TECHNIQUES: [(&str, &str, f64); 9] = [
    ("\"hamburger4\"", "unorm16", 0.9),
    ("\"hamburger4\"", "float16", 1.5),
    ("\"hamburger4\"", "float32", 0.9),
    ("\"hausdorff4\"", "float32", 0.9),
    ("\"hamburger6\"", "unorm16", 0.9),
    ("\"evsm4\"", "float32", 0.9),
    ("\"vsm\"", "unorm16", 0.9),
    ("\"esm\"", "float32", 1.5),
    ("{ \"lvsm\": { \"layers\": 4 } }", "unorm16", 0.9),
];

/// A place in the shadow of the box.
const SHADE: [usize; 2] = [327, 182];

fn of_technique(technique: &str, storage: &str) -> Look {
    let mut look = filtered("hamburger4");
    let graph = look.graph.as_mut().expect("a graph");
    let properties = format!("{{ \"technique\": {technique}, \"storage\": \"{storage}\" }}");
    *graph = graph.replace("{ \"storage\": [\"unorm16\", \"float16\"] }", &properties);
    look
}

#[test]
fn the_sun_beside_bevys_own_filter() {
    let (truth, _) = drawn("sun_truth", &truth(&Look::default()));
    let (bevys, bevys_time) = drawn("sun_bevys", &Look::default());
    let skipped = Look {
        enabled: false,
        ..filtered("hamburger4")
    };
    let (skipped, _) = drawn("sun_skipped", &skipped);
    let none = difference(&skipped, &truth);
    println!(
        "sun: Bevy's own bias {:.3}, node skipped {none:.3} of 255",
        difference(&bevys, &truth)
    );
    assert!(none > 5.0, "{none}");
    let in_shade =
        |picture: &common::Picture| brightness(picture, SHADE) - brightness(&truth, SHADE);
    assert!(in_shade(&skipped) > 60.0, "{}", in_shade(&skipped));
    let mut worse = Vec::new();
    for (technique, storage, most) in TECHNIQUES {
        let name = technique.replace(|c: char| !c.is_alphanumeric(), "");
        let (ours, time) = drawn(
            &format!("sun_{name}_{storage}"),
            &of_technique(technique, storage),
        );
        let apart = difference(&ours, &truth);
        println!(
            "sun: {name} {storage}: {apart:.3} of 255, frame time {:.2} of Bevy's",
            time / bevys_time
        );
        assert!(in_shade(&ours).abs() < 12.0, "{name}: {}", in_shade(&ours));
        if apart >= most {
            worse.push(format!(
                "{technique} in {storage}: {apart:.3}, at most {most}"
            ));
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
}

#[test]
fn cascades_beside_bevys_own_filter() {
    let look = |look: Look| Look {
        cascades: 3,
        ..look
    };
    let (truth, bevys_time) = drawn("cascades_truth", &truth(&look(Look::default())));
    let (ours, time) = drawn("cascades", &look(filtered("hamburger4")));
    let apart = difference(&ours, &truth);
    println!(
        "three cascades: {apart:.3} of 255, frame time {:.2} of Bevy's",
        time / bevys_time
    );
    assert!(apart < 1.0, "{apart}");
}

#[test]
fn a_map_with_mip_levels() {
    let (truth, _) = drawn("mips_truth", &truth(&Look::default()));
    let mut look = filtered("hamburger4");
    let graph = look.graph.as_mut().expect("a graph");
    let downsample = "{ \"name\": \"downsample\", \"type\": \"downsample\" }";
    let edge = "{ \"from\": \"blur.blurred\", \"to\": \"downsample.map\" }";
    *graph = graph
        .replace(
            "1] } } }",
            &format!("1] }}, \"mip_levels\": \"all\" }} }}, {downsample}"),
        )
        .replace(
            "\"to\": \"blur.map\" }",
            &format!("\"to\": \"blur.map\" }}, {edge}"),
        )
        .replace(
            "\"shadow_map\", \"from\": \"blur.blurred\"",
            "\"shadow_map\", \"from\": \"downsample.map\"",
        );
    let (ours, _) = drawn("mips", &look);
    let apart = difference(&ours, &truth);
    println!("with mip levels: {apart:.3} of 255");
    assert!(apart < 1.0, "{apart}");
}

#[test]
fn several_samples_per_pixel() {
    let look = |look: Look| Look {
        msaa: bevy::render::view::Msaa::Sample4,
        ..look
    };
    let (truth, _) = drawn("msaa_truth", &truth(&look(Look::default())));
    let (ours, _) = drawn("msaa", &look(filtered("hamburger4")));
    let apart = difference(&ours, &truth);
    println!("four samples per pixel: {apart:.3} of 255");
    assert!(apart < 1.0, "{apart}");
}

#[test]
fn a_spot_light_beside_bevys_own_filter() {
    for (name, cascades) in [("spot", 0), ("spot_and_sun", 2)] {
        let look = |look: Look| Look {
            cascades,
            spot: true,
            ..look
        };
        let bevys = truth(&look(Look::default()));
        let (truth, _) = drawn(&format!("{name}_truth"), &bevys);
        let (lit, _) = drawn(
            &format!("{name}_lit"),
            &look(Look {
                shadows: false,
                ..Look::default()
            }),
        );
        let (ours, _) = drawn(name, &look(filtered("hamburger4")));
        let (apart, none) = (difference(&ours, &truth), difference(&lit, &truth));
        println!("{name}: {apart:.3}, without shadows {none:.3} of 255");
        assert!(none > 5.0, "{none}");
        assert!(apart < 1.0, "{apart}");
    }
}

#[test]
fn two_cameras_have_their_own_maps() {
    let eyes = [Look::EYE, Look::OTHER_EYE];
    let look = |eyes: &[_]| Look {
        eyes: eyes.to_vec(),
        cascades: 3,
        ..filtered("hamburger4")
    };
    let mut both = Stage::new(&look(&eyes), SIZE);
    let both = pictures("cameras", &mut both);
    for (number, eye) in eyes.into_iter().enumerate() {
        let (alone, _) = drawn(&format!("camera_alone_{number}"), &look(&[eye]));
        let (truth, _) = drawn(&format!("camera_truth_{number}"), &truth(&look(&[eye])));
        let (together, right) = (
            difference(&both[number], &alone),
            difference(&alone, &truth),
        );
        println!(
            "camera {number}: {together:.4} from the same alone, which is {right:.3} from the truth, of 255"
        );
        assert!(together < 0.01, "{together}");
        assert!(right < 1.0, "{right}");
    }
    assert!(difference(&both[0], &both[1]) > 10.0);
}

/// A sun of ten degrees: the mean of Bevy's own shadows from places on its disk is the truth.
#[test]
fn soft_shadows_from_a_table() {
    const PLACES: usize = 32;
    let diameter = 10f64.to_radians();
    let mut stage = Stage::new(&truth(&Look::default()), SIZE);
    let mut sum = Vec::new();
    for place in 0..PLACES {
        // Evenly on a disk: a spiral of the golden angle.
        let radius = (0.5 * diameter).tan() * ((place as f64 + 0.5) / PLACES as f64).sqrt();
        let angle = 2.399_963 * place as f64;
        let turned = sun([(radius * angle.cos()) as f32, (radius * angle.sin()) as f32]);
        let world = stage.app().world_mut();
        let mut suns = world.query_filtered::<&mut Transform, With<DirectionalLight>>();
        suns.iter_mut(world).for_each(|mut sun| *sun = turned);
        let picture = pictures("soft_place", &mut stage).swap_remove(0);
        sum.resize(picture.len(), 0.0);
        sum.iter_mut()
            .zip(picture)
            .for_each(|(sum, value)| *sum += value / PLACES as f64);
    }
    keep("soft_truth", &sum);
    let (hard, _) = drawn("soft_hard", &filtered("hamburger4"));
    let (ours, _) = drawn(
        "soft",
        &Look {
            sun: diameter,
            ..filtered("soft")
        },
    );
    let (apart, none) = (difference(&ours, &sum), difference(&hard, &sum));
    println!(
        "a sun of ten degrees: {apart:.3} from {PLACES} places, hard shadows {none:.3} of 255"
    );
    assert!(apart < 0.65 * none, "{apart}");
}
