//! What the schema of graph files refuses is what the library refuses.

use std::path::Path;

use moment_shadows_graph::{Graph, NodeRegistry};
use serde_json::{Value, json};

/// Whether the schema and the library take a file; both have to agree.
fn taken(file: &Value) -> bool {
    let schema = jsonschema::validator_for(&Graph::schema()).unwrap();
    let by_schema = schema.validate(file).map_err(|error| error.to_string());
    let parsed = Graph::parse(&file.to_string(), &NodeRegistry::new());
    let by_library = parsed.map(drop).map_err(|error| error.to_string());
    assert_eq!(
        by_schema.is_ok(),
        by_library.is_ok(),
        "{by_schema:?} {by_library:?} {file}"
    );
    by_schema.is_ok()
}

/// The files in a folder that are graphs, with their names.
fn graphs(folder: &str) -> Vec<(String, Value)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let files = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let files = files.filter(|path| path.extension().is_some_and(|ending| ending == "json"));
    let read = |path: std::path::PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        (
            path.display().to_string(),
            serde_json::from_str(&text).unwrap(),
        )
    };
    let all = files.map(read);
    all.filter(|(_, file): &(_, Value)| file["nodes"].is_array())
        .collect()
}

#[test]
fn every_graph_of_the_repository_is_taken() {
    let folders = [
        "examples",
        "tests/support",
        "examples/egui_host",
        "examples/hosts/frame_graph/graphs",
        "examples/hosts/bevy/graphs",
    ];
    let all: Vec<_> = folders.into_iter().flat_map(graphs).collect();
    assert!(all.len() >= 9, "{}", all.len());
    for (name, file) in all {
        assert!(taken(&file), "{name}");
    }
}

fn example() -> Value {
    serde_json::from_str(include_str!("../support/example.json")).unwrap()
}

#[test]
fn settings_in_every_form_are_taken() {
    let resolve = |properties: Value| {
        let mut file = example();
        file["nodes"][0]["properties"] = properties;
        taken(&file)
    };
    for properties in [
        json!({}),
        json!({ "technique": "evsm4" }),
        json!({ "technique": { "evsm4": { "positive": 12 } }, "storage": ["float16", "float32"] }),
        json!({ "technique": { "lvsm": { "layers": 3, "splits": { "given": [-0.5, 0.5] } } } }),
        json!({ "technique": { "pcf": { "weights": [1, 2, 1] } } }),
        json!({ "storage": "best", "mip_levels": "all" }),
        json!({ "storage": "unorm16", "mip_levels": 3 }),
        json!({ "technique": "best" }),
        json!({ "technique": "best", "bits": 128 }),
    ] {
        assert!(resolve(properties.clone()), "{properties}");
    }
    let mut file = example();
    file["$schema"] = json!("../graph/graph_file.schema.json");
    file["nodes"][1]["properties"] =
        json!({ "kernel": { "weights": [1, 2, 1] }, "per_frame": true });
    assert!(taken(&file));
}

#[test]
fn what_is_wrong_is_refused_by_both() {
    let wrong: [fn(&mut Value); 19] = [
        |file| file["extra"] = json!(1),
        |file| file["$schema"] = json!(1),
        |file| file["version"] = json!(3),
        |file| file["version"] = json!("2"),
        |file| drop(file.as_object_mut().unwrap().remove("edges")),
        |file| file["imports"] = json!({}),
        |file| file["imports"][0]["texture"]["format"] = json!("depth32"),
        |file| file["imports"][0]["texture"]["size"] = json!([16]),
        |file| file["imports"][0]["texture"]["depth"] = json!(1),
        |file| file["nodes"][0]["type"] = json!("resolve_moment"),
        |file| file["nodes"][0]["kind"] = json!("resolve"),
        |file| file["nodes"][0]["properties"]["storge"] = json!("unorm16"),
        |file| file["nodes"][0]["properties"]["storage"] = json!("unorm15"),
        |file| file["nodes"][0]["properties"]["technique"] = json!("evsm5"),
        |file| file["nodes"][0]["properties"]["technique"] = json!({ "vsm": {}, "esm": {} }),
        |file| file["nodes"][0]["properties"]["bits"] = json!(-64),
        |file| file["nodes"][1]["properties"] = json!({}),
        |file| file["edges"][0]["via"] = json!("x"),
        |file| file["outputs"][0] = json!({ "name": "x" }),
    ];
    for (index, spoil) in wrong.into_iter().enumerate() {
        let mut file = example();
        spoil(&mut file);
        assert!(!taken(&file), "{index}");
    }
}
