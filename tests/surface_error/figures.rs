//! The figures: on scenes whose error is known, against exact bounds, and repeated.

use moment_shadows::{FourMomentsBias, Storage};
use moment_shadows_graph::command::CommandError;
use moment_shadows_lab::candidate::Candidate;
use moment_shadows_lab::command::error;
use moment_shadows_lab::command::error::ErrorReport;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::judgement::Unfiltered;
use moment_shadows_lab::scene;
use moment_shadows_lab::truth::exact_bound::biased_bound;
use moment_shadows_lab::truth::lookup::Lookup;
use moment_shadows_lab::truth::pcf::{Receiver, pcf_at};
use moment_shadows_lab::truth::peel::Peeler;

use crate::setup::{graph, open, options, plate, scene as scene_of, subject, table_options};

#[test]
fn two_plates_have_the_error_of_leak_reduction_alone() {
    // The light shines straight down on plates of one size: four moments describe one depth, and with it every
    // surface's shadow. Where the kernel sees the plates' border it is two.
    let gpu = open();
    let mut ground = plate(30.0, -1.0);
    ground.ground = true;
    let mut scene = scene_of(vec![plate(1.0, 1.0), plate(1.0, 0.0), ground]);
    scene.stand = Some(scene::Stand {
        eye: glam::DVec3::new(0.0, 3.0, 6.0),
        target: glam::DVec3::ZERO,
        light_direction: glam::DVec3::NEG_Y,
    });
    let (map, radius) = (64, 2);
    let subject = subject(&gpu, &scene, &options(map, 1), radius);
    let found = subject
        .judge(&gpu, &graph(Storage::Float32, radius), None)
        .unwrap()
        .surfaces;
    // A margin of radius + 2 texels on each side of the plates.
    let side = u64::from(map - 2 * (radius + 2));
    assert_eq!(found.rays, u64::from(map * map));
    assert_eq!(found.caster_rays, side * side);
    assert_eq!(found.peels, 3);
    assert_eq!(found.shading.samples as u64, 3 * side * side);
    let empty = u64::from(map * map) - side * side;
    assert_eq!(
        found.shading_all_rays.samples as u64,
        3 * side * side + empty
    );
    assert_eq!(found.shading_facing.samples, found.shading.samples);
    assert_eq!(found.nan, 0);
    // Two depths at most, the plate's and the far end: four moments describe them without an error, and no bound falls
    // short but by the bias. Shading counts 0.98 as full shadow, so a penumbra is too dark by up to 1/0.98 - 1 of itself.
    println!("{found:?}");
    assert!(found.distribution.maximum < 1e-5);
    assert_eq!(found.shading.leaking, 0.0);
    assert!(found.shading.overdarkening > 0.0);
    assert!(found.shading.maximum < 0.0205, "{}", found.shading.maximum);
    // A bias of 1 forgets all moments for those of occluders at both ends and the middle: two thirds of the surfaces are
    // in full shadow, and get no more than the first of these.
    let forgetful = FourMomentsBias {
        alpha: 1.0,
        second: 0.628,
        fourth: 0.628,
    };
    let file = graph(Storage::Float32, radius);
    let found = subject
        .judge(&gpu, &file, Some(forgetful))
        .unwrap()
        .surfaces;
    println!("{found:?}");
    assert!(found.shading.mean_absolute > 0.2);
}

#[test]
fn the_distribution_s_error_is_that_of_the_exact_bound() {
    // Device and f32 on one side, peels with bounds of biased moments in f64 on the other.
    let gpu = open();
    let scene = scene::load("hall").unwrap();
    let (options, radius) = (options(128, 4), 4);
    let subject = subject(&gpu, &scene, &options, radius);
    let (light, map) = (subject.frame().desc.light, subject.frame().desc.map);
    let unfiltered =
        Unfiltered::of(&gpu, subject.frame(), &graph(Storage::Float32, radius)).unwrap();
    let mut surfaces = Peeler::new(&scene, &light, map).unwrap().rows(0..map[1]);
    let casters: std::collections::HashSet<[u32; 2]> = surfaces
        .iter()
        .filter(|surface| !surface.ground)
        .map(|surface| surface.texel)
        .collect();
    surfaces.retain(|surface| casters.contains(&surface.texel));
    let lookups: Vec<Option<Lookup>> = surfaces
        .iter()
        .map(|surface| {
            Some(Lookup {
                uv: surface.texel.map(|at| (f64::from(at) + 0.5) / 128.0),
                fragment_depth: light.moment_depth_of_distance(surface.distance).min(1.0),
            })
        })
        .collect();
    let axis = light
        .view_from_world
        .inverse()
        .transform_vector3(glam::DVec3::Z);
    let receivers: Vec<Receiver> = surfaces
        .iter()
        .map(|surface| Receiver {
            position: surface.position,
            normal: axis,
        })
        .collect();
    let truth = pcf_at(&light, &unfiltered.depths, &unfiltered.taps, &receivers);
    for storage in Storage::OF_FOUR_MOMENTS {
        let found = subject.judge(&gpu, &graph(storage, radius), None).unwrap();
        let found = found.surfaces.distribution;
        let bound = biased_bound(
            &unfiltered.depths,
            &unfiltered.taps,
            &lookups,
            storage.moment_bias(),
        );
        let errors: f64 = bound
            .iter()
            .zip(&truth)
            .map(|(&bound, &truth)| f64::from((bound - truth).abs()))
            .sum();
        let expected = errors / bound.len() as f64;
        println!("{storage}: {} expected {expected}", found.mean_absolute);
        assert_eq!(found.samples, bound.len());
        // What rounding in storage adds goes either way, and is at most half a percent of the error in pictures, too.
        assert!(
            (found.mean_absolute / expected - 1.0).abs() < 5e-3,
            "{storage}"
        );
    }
}

fn report() -> ErrorReport {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json");
    let mut options = options(128, 4);
    options.scene = "hall".to_owned();
    error::measure(&options, &path, Some(3), None).unwrap()
}

#[test]
fn figures_repeat_to_the_last_digit() {
    let first = report();
    let json = serde_json::to_string(&first).unwrap();
    assert_eq!(json, serde_json::to_string(&report()).unwrap());
    // However many threads there are.
    for threads in [1, 5] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let again = pool.install(report);
        assert_eq!(json, serde_json::to_string(&again).unwrap(), "{threads}");
    }
    let text = first.to_string();
    for part in [
        "hall", "unorm16", "radius 3", "128x128", "too dark", "peels",
    ] {
        assert!(text.contains(part), "{part} is not in\n{text}");
    }
    assert_eq!(first.kernel.unwrap().radius, 3);
}

#[test]
fn the_table_has_a_row_for_each_scene_radius_and_storage() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json");
    let scenes = ["hall", "fence-and-foliage"].map(str::to_owned).to_vec();
    let candidates = Storage::OF_FOUR_MOMENTS.map(Candidate::Storage);
    let options = table_options(&path, options(64, 1), scenes, &[1, 2], 1);
    let table = options.measure(&candidates).unwrap();
    let keys: Vec<_> = table
        .rows
        .iter()
        .map(|row| (row.scene.as_str(), row.radius, row.errors.storage))
        .collect();
    let mut expected = Vec::new();
    for scene in ["hall", "fence-and-foliage"] {
        for radius in [1, 2] {
            expected.extend(Storage::OF_FOUR_MOMENTS.map(|storage| (scene, radius, Some(storage))));
        }
    }
    assert_eq!(keys, expected);
    let text = table.to_string();
    let lines = text.lines().skip_while(|line| !line.starts_with("scene"));
    assert_eq!(lines.count(), 1 + 12, "{text}");
}

#[test]
fn what_cannot_be_measured_is_named() {
    let gpu = open();
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json");
    let text = std::fs::read_to_string(path).unwrap();
    let without_shading = r#"{
  "version": 2,
  "imports": [{ "name": "light_depth" }],
  "nodes": [{ "name": "resolve", "type": "resolve", "properties": { "storage": "float32" } }],
  "edges": [{ "from": "light_depth", "to": "resolve.depth" }],
  "outputs": [{ "name": "map", "from": "resolve.map" }]
}"#;
    let parse = |text: &str| GraphFile::parse("the.json", text.to_owned(), None).unwrap();
    let refused = parse(without_shading).with_filtered_map().unwrap_err();
    assert!(matches!(&refused, LabError::Unsuitable { file, .. } if file == "the.json"));
    assert!(
        refused.to_string().contains("no shade_hard node"),
        "{refused}"
    );
    let refused = parse(without_shading).with_radius(3).unwrap_err();
    assert!(refused.to_string().contains("no blur node"), "{refused}");
    assert!(matches!(
        parse(&text).with_radius(65).unwrap_err(),
        LabError::Command(CommandError::Graph { .. })
    ));
    // A map that a graph gives out already keeps its name.
    let given = text.replace(
        r#""outputs": ["#,
        r#""outputs": [ { "name": "mine", "from": "blur.blurred" },"#,
    );
    assert_eq!(parse(&given).with_filtered_map().unwrap().1, "mine");
    // Casters smaller than a texel, between the rays.
    let mut ground = plate(30.0, 0.0);
    ground.ground = true;
    let mut speck = plate(1e-3, 0.5);
    speck
        .positions
        .iter_mut()
        .for_each(|position| position[0] += 0.8);
    let mut other = plate(1e-3, 1.0);
    other
        .positions
        .iter_mut()
        .for_each(|position| position[0] -= 0.8);
    let scene = scene_of(vec![speck, other, ground]);
    let file = graph(Storage::Float32, 1);
    let options = options(16, 1);
    let drawn = options.drawn(&file).unwrap();
    let refused = moment_shadows_lab::command::error::ErrorSubject::new(
        &gpu,
        &scene,
        (&options, &drawn),
        &file,
        || (),
    )
    .err()
    .unwrap();
    assert!(
        refused
            .to_string()
            .contains("meets a caster of scene 'test'"),
        "{refused}"
    );
}
