//! Trades from end to end.

use std::fs;

use moment_shadows_lab::trade::results::{Results, Row};

use crate::small;

fn rows(results: &Results) -> &[Row] {
    &results.scenes[0].rows
}

/// Errors are the same to the last digit, whatever was found by an earlier run; what was found is not measured again.
#[test]
fn a_trade_goes_on_where_it_stopped_with_the_same_errors() {
    let trade = small(&["vsm", "hamburger4"]);
    let whole = tempfile::tempdir().unwrap();
    let results = trade.run(whole.path()).unwrap();
    // Two techniques with two and five storages, two maps, one and four samples.
    assert_eq!(rows(&results).len(), 28);
    assert!(!whole.path().join("unfinished.jsonl").exists());
    // A journal that ends in the middle of a line.
    let stopped = tempfile::tempdir().unwrap();
    let setting = serde_json::to_string(&results.setting).unwrap();
    let row = serde_json::json!({ "found": "row", "scene": "fence-and-foliage", "row": rows(&results)[5], "crop": null });
    let torn = "{\"found\":\"row\",\"scene\":\"fence-and-fol";
    let journal = stopped.path().join("unfinished.jsonl");
    fs::write(&journal, format!("{setting}\n{row}\n{torn}")).unwrap();
    let again = trade.run(stopped.path()).unwrap();
    for (one, other) in rows(&results).iter().zip(rows(&again)) {
        assert_eq!(
            (one.cell, &one.views),
            (other.cell, &other.views),
            "{}",
            one.name
        );
        assert_eq!(one.bytes_resident, other.bytes_resident);
    }
    assert_eq!(rows(&again)[5], rows(&results)[5]);
    assert_eq!(again.scenes[0].probes, results.scenes[0].probes);
    // A finished one is read, with the same times.
    let read = trade.run(whole.path()).unwrap();
    assert_eq!(rows(&read), rows(&results));
    page(
        &results,
        &fs::read_to_string(whole.path().join("report.html")).unwrap(),
    );
    let svg = "front-fence-and-foliage-4-time.svg";
    let svg = fs::read_to_string(whole.path().join(svg)).unwrap();
    assert_eq!(svg.matches("<circle").count(), 28);
    figures(&results);
}

/// The page asks for nothing else, and has every row.
fn page(results: &Results, page: &str) {
    for foreign in ["src=\"http", "href=\"http", "<script", "@import", "url("] {
        assert!(!page.contains(foreign), "{foreign}");
    }
    let body = page.matches("<tr>").count() - page.matches("<thead><tr>").count();
    assert_eq!(body, rows(results).len());
    // Pictures of the largest map with the most samples.
    assert_eq!(page.matches("data:image/png;base64,").count(), 7);
}

/// What the figures have to say whatever the device: more samples and a larger map err less, and so do more moments.
fn figures(results: &Results) {
    let error = |name: &str, storage: &str, map: u32, samples: u32| {
        let is_it = |row: &&Row| {
            let stored = row.storage.unwrap().name();
            (row.name.as_str(), stored, row.cell.map, row.cell.samples)
                == (name, storage, map, samples)
        };
        rows(results).iter().find(is_it).unwrap().error().unwrap()
    };
    let best = error("hamburger4", "float32", 256, 4);
    for worse in [
        error("hamburger4", "float32", 256, 1),
        error("hamburger4", "float32", 128, 4),
        error("vsm", "float32", 256, 4),
        error("hamburger4", "float16", 256, 4),
    ] {
        assert!(best < 0.97 * worse, "{best} {worse}");
    }
    for row in rows(results) {
        assert!(row.time.total.median > 0.0 && row.time.map.median > 0.0);
        assert!(
            row.views
                .iter()
                .all(|view| view.nan == 0 && view.surfaces.is_some())
        );
        assert!(row.isa.is_some(), "{}", row.name);
    }
}

#[test]
fn scenes_and_settings_that_cannot_be_are_refused_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |scene: &str| {
        let mut trade = small(&["vsm"]);
        trade.scenes = vec!["fence-and-foliage".to_owned(), scene.to_owned()];
        let refused = trade.run(folder.path()).unwrap_err().to_string();
        assert!(!folder.path().join("unfinished.jsonl").exists());
        refused
    };
    assert!(refused("nothing.glb").contains("there is no file 'nothing.glb'"));
    let path = |name: &str| folder.path().join(name).display().to_string();
    fs::write(path("broken.glb"), "no scene").unwrap();
    assert!(refused(&path("broken.glb")).contains("broken.glb"));
    let empty = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[]}]}";
    fs::write(path("empty.gltf"), empty).unwrap();
    let said = refused(&path("empty.gltf"));
    assert!(
        said.contains("empty.gltf") && said.contains("triangle"),
        "{said}"
    );
    // Views beside a scene: what is wrong with them is said with their name.
    fs::write(path("fence.views.json"), "{\"views\":[]}").unwrap();
    fs::write(path("fence.glb"), "no scene").unwrap();
    assert!(refused(&path("fence.glb")).contains("fence.views.json: it has no view"));
    fs::write(path("fence.views.json"), "{\"view\":[]}").unwrap();
    assert!(refused(&path("fence.glb")).contains("unknown field `view`"));
    // A folder that another setting is in.
    let trade = small(&["vsm"]);
    fs::write(folder.path().join("unfinished.jsonl"), "{}\n").unwrap();
    let said = trade.run(folder.path()).unwrap_err().to_string();
    assert!(
        said.contains("of another setting, device or version"),
        "{said}"
    );
}
