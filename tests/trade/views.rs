//! Views and lights that a scene's owner gives beside it.

use std::fs;
use std::path::Path;

use serde_json::{Value, json};

use moment_shadows_lab::trade::results::SceneResults;

use crate::small;

/// A row of triangles that stand upright, 4 wide and 3 high, from z = 0 on every 10 further away.
fn row_of_sails(folder: &Path) -> String {
    let corners = [[-2.0_f32, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let bytes = corners
        .as_flattened()
        .iter()
        .flat_map(|at| at.to_le_bytes());
    fs::write(folder.join("sail.bin"), Vec::from_iter(bytes)).unwrap();
    let nodes = (0..5).map(|number| json!({ "mesh": 0, "translation": [0, 0, -10 * number] }));
    let document = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0, 1, 2, 3, 4] }], "nodes": Vec::from_iter(nodes),
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{ "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-2, 0, 0], "max": [2, 3, 0] }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }], "buffers": [{ "uri": "sail.bin", "byteLength": 36 }]
    });
    let path = folder.join("sails.gltf");
    fs::write(&path, document.to_string()).unwrap();
    path.display().to_string()
}

/// Says how the row is seen: from in front of it and along it.
fn give(folder: &Path, light: &Value) {
    let view = json!({ "eye": [3, 2, 6], "target": [0, 1, -8], "light": light });
    let views = json!({ "views": [view] }).to_string();
    fs::write(folder.join("sails.views.json"), views).unwrap();
}

/// Each cascade is judged by its own map and the pixels that lie in it.
#[test]
fn cascades_are_judged_each_by_its_pixels() {
    let folder = tempfile::tempdir().unwrap();
    let mut trade = small(&["hamburger4"]);
    trade.scenes = vec![row_of_sails(folder.path())];
    trade.axes.maps = vec![256];
    trade.axes.samples = vec![1];
    trade.stride = 1;
    let mut sun = json!({ "type": "sun", "direction": [0.5, -1, -0.3] });
    let mut run = || {
        give(folder.path(), &sun);
        let out = tempfile::tempdir().unwrap();
        let results = trade.run(out.path()).unwrap();
        sun["cascades"] = json!([14, 30, 50]);
        results.scenes[0].clone()
    };
    let [whole, cascades] = [run(), run()];
    assert_eq!([&whole, &cascades].map(|it| it.probes.len()), [1, 3]);
    // The map of all casters has no texels for much of the ground; those of cascades have for all pixels that they are judged by.
    let outside = |scene: &SceneResults| {
        scene
            .probes
            .iter()
            .map(|probe| probe.outside)
            .fold(0.0, f64::max)
    };
    assert!(outside(&whole) > 0.1, "{}", outside(&whole));
    assert_eq!(outside(&cascades), 0.0);
    for row in &cascades.rows {
        assert!(
            row.errors().iter().all(|&error| error > 0.0 && error < 0.1),
            "{:?}",
            row.errors()
        );
        assert_eq!(row.errors().len(), 3);
    }
}

#[test]
fn cascades_that_do_not_ascend_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let mut trade = small(&["vsm"]);
    trade.scenes = vec![row_of_sails(folder.path())];
    for ends in [json!([8, 8]), json!([0, 8]), json!([-1])] {
        give(
            folder.path(),
            &json!({ "type": "sun", "direction": [0, -1, 0], "cascades": ends }),
        );
        let refused = trade.run(folder.path()).unwrap_err().to_string();
        assert!(
            refused.contains("sails.views.json: cascades of view 0 end at")
                && refused.contains("give distances that ascend from above 0"),
            "{refused}"
        );
    }
    let spot = json!({ "type": "spot", "position": [0, 9, 0], "direction": [0, -1, 0], "angle": 1, "range": [1, 9], "cascades": [9] });
    give(folder.path(), &spot);
    let refused = trade.run(folder.path()).unwrap_err().to_string();
    assert!(refused.contains("unknown field `cascades`"), "{refused}");
}

/// Cascades without anything to judge are named.
#[test]
fn a_cascade_beyond_the_scene_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let mut trade = small(&["vsm"]);
    trade.scenes = vec![row_of_sails(folder.path())];
    trade.stride = 1;
    let sun = json!({ "type": "sun", "direction": [0.5, -1, -0.3], "cascades": [200, 201] });
    give(folder.path(), &sun);
    let refused = trade.run(folder.path()).unwrap_err().to_string();
    assert!(
        refused.contains("sails, view 1: no ray of the light meets a caster"),
        "{refused}"
    );
}
