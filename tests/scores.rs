//! Each score sees what it is for, and nothing where that is not there.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::path::Path;

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::candidate::{TechniqueChoice, candidates};
use moment_shadows_lab::scene::{CHAIRS, SLOPES};
use moment_shadows_lab::scores::{NAMES, Report, STEP, Scored, Scores};
use moment_shadows_lab::trade::axes::Axes;
use moment_shadows_lab::trade::{Job, Trade};

/// Scores of some techniques on a scene that take seconds, with a constant bias in texels.
fn scores(scene: &str, names: &[&str], constant: f64) -> Scores {
    let choices: Vec<TechniqueChoice> = names.iter().map(|name| name.parse().unwrap()).collect();
    let mut candidates = candidates(&choices, None).unwrap();
    candidates.retain(|candidate| Axes::offers(Profile::Native, candidate));
    Scores {
        graph: None,
        trade: Trade {
            scenes: vec![scene.to_owned()],
            axes: Axes {
                maps: vec![512],
                radii: vec![2],
                samples: vec![1],
                candidates,
            },
            profile: Profile::Native,
            picture: [320, 180],
            views: [1, 0],
            rounds: 9,
            stride: 8,
            ground: true,
            jobs: vec![Job::Hard],
        },
        constant: Some(constant),
        step: STEP,
    }
}

fn run(scores: &Scores) -> Report {
    scores.run(None, || ()).unwrap()
}

/// What a row has of its only view: acne and lost shadow, each with a constant bias and with ours.
fn biases(row: &Scored) -> [[f64; 2]; 2] {
    let [view] = row.views.as_slice() else {
        panic!("{row:?}");
    };
    let [constant, ours] = [&view.acne.constant, &view.acne.ours];
    let acne = [constant, ours].map(|acne| acne.as_ref().unwrap().mean);
    let panning = view.peter_panning;
    [acne, [panning.constant, panning.ours].map(Option::unwrap)]
}

/// What the only storage of a technique has with our bias: acne and lost shadow.
fn of(scores: &Scores, storage: Storage) -> [f64; 2] {
    let rows = run(scores).rows;
    let of_storage = |row: &&Scored| row.storage == Some(storage);
    biases(rows.iter().find(of_storage).unwrap()).map(|of| of[1])
}

/// Its depths are coarse, and rounded away from the light.
#[test]
fn texels_that_are_written_once_cast_no_shadow_on_their_surface() {
    let usual = scores(SLOPES, &["hamburger4"], 0.0);
    let [acne, lost] = of(&usual, Storage::Packed32);
    let [_, before] = of(&usual, Storage::Unorm16);
    println!("acne {acne}, lost {lost}, {before} as unorm16");
    assert!(acne < 5e-4, "{acne}");
    assert!(lost < before, "{lost}, {before}");
}

/// No more of it where texels are rounded inwards, whose bias is a quarter, and less shadow is lost.
#[test]
fn texels_that_are_rounded_inwards_cast_no_shadow_on_their_surface() {
    let usual = scores(SLOPES, &["hamburger4"], 0.0);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/resolved_blur.json");
    let inwards = Scores {
        graph: Some(path),
        ..usual.clone()
    };
    for storage in [Storage::Unorm16, Storage::Float16] {
        let ([acne, lost], [_, before]) = (of(&inwards, storage), of(&usual, storage));
        println!("{storage}: acne {acne}, lost {lost} in place of {before}");
        assert!(acne < 5e-4, "{storage}: {acne}");
        assert!(lost < 0.8 * before, "{storage}: {lost}, {before}");
    }
}

#[test]
fn no_bias_is_acne_a_large_one_is_peter_panning_and_ours_is_neither() {
    let names = ["pcf", "vsm", "hamburger4"];
    let none = run(&scores(SLOPES, &names, 0.0));
    let large = run(&scores(SLOPES, &names, 40.0));
    for row in &none.rows {
        let [[acne, our_acne], [lost, _]] = biases(row);
        println!(
            "none  {} {:?} {acne} {our_acne} {lost}",
            row.name, row.storage
        );
        // Filters hide most of it. The plane of a pixel's neighbours is that of another facet at times, which a test on the depth map
        // has no room for.
        let is_test = row.storage.is_none();
        let [least, most] = if is_test { [0.3, 0.05] } else { [0.0, 5e-4] };
        assert!(acne > least, "{}: {acne}", row.name);
        assert!(
            our_acne < most && our_acne < acne,
            "{}: {our_acne}",
            row.name
        );
        assert_eq!(lost, 0.0, "{}", row.name);
    }
    for row in &large.rows {
        let [[acne, _], [lost, our_loss]] = biases(row);
        println!("large {} {acne} {lost} {our_loss}", row.name);
        assert!(acne < 0.01, "{}: {acne}", row.name);
        assert!(lost > 0.5, "{}: {lost}", row.name);
        assert!(our_loss < 0.05 * lost, "{}: {our_loss} {lost}", row.name);
    }
}

#[test]
fn every_slope_is_a_class_of_its_own() {
    let report = run(&scores(SLOPES, &["pcf"], 0.0));
    let view = &report.rows[0].views[0];
    let [constant, ours] = [&view.acne.constant, &view.acne.ours].map(|it| it.clone().unwrap());
    println!("{constant:?} {ours:?}");
    assert!(ours.slopes.iter().all(Option::is_some), "{ours:?}");
    // Without a bias every slope but the one that faces the light shadows itself.
    let slopes = constant.slopes.map(Option::unwrap);
    assert!(slopes[1..].iter().all(|slope| *slope > 0.2), "{slopes:?}");
}

#[test]
fn a_map_that_slides_by_whole_texels_does_not_flicker() {
    let names = ["binary", "hamburger4"];
    let flickers = |step| {
        let sliding = Scores {
            step,
            ..scores(SLOPES, &names, 0.0)
        };
        let rows = run(&sliding).rows;
        Vec::from_iter(rows.iter().map(|row| {
            let flicker = row.views[0].flicker.unwrap();
            assert!(flicker.worst >= flicker.mean);
            (row.name.clone(), flicker.mean)
        }))
    };
    let (snapped, sliding) = (flickers([1.0, 0.0]), flickers(STEP));
    println!("{snapped:?} {sliding:?}");
    for ((name, snapped), (_, sliding)) in snapped.iter().zip(&sliding) {
        assert!(*snapped < 0.05 * sliding, "{name}: {snapped} {sliding}");
        assert!(*sliding > 1e-4, "{name}: {sliding}");
    }
    // A filter is what softens it.
    let of = |wanted: &str| {
        let found = sliding.iter().filter(|(name, _)| name.starts_with(wanted));
        found.map(|(_, flicker)| *flicker).fold(0.0, f64::max)
    };
    assert!(of("binary") > 1.5 * of("hamburger4"), "{sliding:?}");
}

#[test]
fn contact_is_scored_around_legs_and_every_score_has_its_picture() {
    let folder = tempfile::tempdir().unwrap();
    let scores = scores(CHAIRS, &["vsm", "hamburger4"], 4.0);
    let report = scores.run(Some(folder.path()), || ()).unwrap();
    let contact = |name: &str| {
        let rows = report.rows.iter().filter(|row| row.name.starts_with(name));
        let contacts = rows.map(|row| row.views[0].contact.unwrap());
        contacts.fold(f64::INFINITY, f64::min)
    };
    let [two, four] = [contact("vsm"), contact("hamburger4")];
    println!("{two} {four}");
    assert!(four > 0.0 && four < two, "{two} {four}");
    for name in NAMES {
        let svg = std::fs::read_to_string(folder.path().join(format!("{name}.svg"))).unwrap();
        // Acne and peter-panning are shown with either bias.
        let biases = if name == "acne" || name == "peter-panning" {
            2
        } else {
            1
        };
        let expected = biases * report.rows.len();
        assert_eq!(svg.matches("<image").count(), expected, "{name}");
    }
    let text = std::fs::read_to_string(folder.path().join("scores.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&text).unwrap();
    assert_eq!(json["rows"].as_array().unwrap().len(), report.rows.len());
    assert!(json["rows"][0]["views"][0]["acne"]["ours"]["mean"].is_number());
}
