//! `soft-error` from end to end.

use moment_shadows_lab::command::soft_error::{SoftErrorOptions, run};
use moment_shadows_lab::compare::Options;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::soft::{NamedGraph, SoftLightChoice, StageDesc};

fn options() -> SoftErrorOptions {
    SoftErrorOptions {
        stage: StageDesc {
            light: SoftLightChoice::Rectangle,
            map: 256,
            width: 64,
            height: 36,
            places: 64,
            ..StageDesc::default()
        },
        ..SoftErrorOptions::default()
    }
}

#[test]
fn it_compares_candidates_and_writes_pictures_and_figures() {
    let folder = tempfile::tempdir().unwrap();
    let graph = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/hard_shadows.json");
    let json = folder.path().join("figures.json");
    let options = SoftErrorOptions {
        graph: vec![NamedGraph {
            name: "mine".to_owned(),
            path: graph.to_owned(),
        }],
        compare: Options {
            scene: ["edge", "hole"].map(str::to_owned).to_vec(),
            only: ["hard", "pcss 32+64", "mine"].map(str::to_owned).to_vec(),
            cost: Some(9),
            out: Some(folder.path().to_owned()),
            json: Some(json.clone()),
        },
        ..options()
    };
    let reports = run(&options).unwrap();
    let read: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string(json).unwrap()).unwrap();
    assert_eq!(read[1]["rows"][1]["name"], "pcss 32+64");
    for (report, scene) in reports.iter().zip(["edge", "hole"]) {
        let [hard, soft, mine] = report.rows.as_slice() else {
            panic!("{report}");
        };
        // `mine` is the graph of `hard` under another name.
        assert_eq!(hard.errors.error, mine.errors.error);
        assert_ne!(hard.errors.error, soft.errors.error);
        assert_eq!(
            hard.errors.error.nan_pixels + soft.errors.error.nan_pixels,
            0
        );
        let cost = soft.cost.as_ref().unwrap();
        assert!(cost.pixels.median > 0.0 && cost.map.is_none());
        assert!(cost.pixels_ratio.median > 0.0, "{report}");
        assert!(hard.cost.unwrap().map.is_some());
        for what in [
            "",
            "-truth",
            "-hard",
            "-pcss-32-64",
            "-pcss-32-64-difference",
        ] {
            let name = format!("{scene}-rectangle{what}.png");
            let bytes = std::fs::read(folder.path().join(&name)).unwrap();
            let picture = image::load_from_memory(&bytes).unwrap();
            let size = if what.is_empty() {
                [4 * 64 + 3 * 4, 2 * 36 + 4]
            } else {
                [64, 36]
            };
            assert_eq!([picture.width(), picture.height()], size, "{name}");
        }
    }
}

#[test]
fn unknown_names_and_scenes_are_refused() {
    let of = |scene: &str, only: &[&str]| {
        let mut options = options();
        options.compare.scene = vec![scene.to_owned()];
        options.compare.only = only.iter().map(|name| (*name).to_owned()).collect();
        run(&options)
    };
    match of("edge", &["pcss"]) {
        Err(LabError::Unsuitable { file, reason }) => {
            assert_eq!(file, "pcss");
            assert!(reason.contains("pcss 32+64"), "{reason}");
        }
        other => panic!("{other:?}"),
    }
    let result = of("edges", &[]);
    assert!(matches!(result, Err(LabError::Refused(_))));
}
