//! The linked text of every node's shader: valid under the profiles that it is for, and equal to its snapshot.
//!
//! `UPDATE_SNAPSHOTS=1 cargo test --test node_shaders` writes the snapshots anew.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use moment_shadows::{Backend, Profile, Source, validate};
use moment_shadows_graph::NodeRegistry;
use moment_shadows_lab::shaders::{self, Shader};

fn variants() -> Vec<Shader> {
    let nodes = shaders::nodes().unwrap();
    nodes.into_iter().map(|node| node.shader).collect()
}

#[test]
fn every_node_of_the_registry_is_in_the_list_of_shaders() {
    let listed: BTreeSet<String> = shaders::nodes()
        .unwrap()
        .into_iter()
        .map(|node| node.node)
        .collect();
    let registry = NodeRegistry::new();
    let registered: BTreeSet<String> = registry.type_names().map(str::to_owned).collect();
    assert_eq!(
        listed, registered,
        "a node's variants are listed in examples/lab/src/shaders/nodes.rs"
    );
}

#[test]
fn the_readme_lists_every_node_with_its_slots() {
    let readme = include_str!("../graph/README.md");
    for node in shaders::nodes().unwrap() {
        let heading = format!("### `{}`\n", node.node);
        let (_, section) = readme
            .split_once(&heading)
            .unwrap_or_else(|| panic!("{heading}"));
        let section = section.split("### ").next().unwrap();
        for slot in node.slots {
            assert!(
                section.contains(&format!("| `{slot}` |")),
                "{}.{slot}",
                node.node
            );
        }
    }
}

/// Variants whose text is kept. The others change a constant each, or repeat lines.
fn is_kept(name: &str) -> bool {
    let ends = |suffixes: &[&str]| suffixes.iter().any(|suffix| name.ends_with(suffix));
    if name.starts_with("summed_area_table") {
        // The tiles of software adapters repeat lines, and so do those of several regions.
        let texels = ends(&["float32_tiles", "float16_tiles"]);
        let plain = !name.contains("software") && !name.contains("regions");
        return plain && (texels || name.starts_with("summed_area_table_unorm16"));
    }
    if name.starts_with("rectify_moments") || name.contains("scattering") {
        // Storages are constants.
        return ends(&["float16"]);
    }
    if name.starts_with("shade_soft") {
        // Storages and ways to look the table up are constants.
        return ["shade_soft_float32", "shade_soft_vsm_float32"].contains(&name);
    }
    if name.contains("unorm10") {
        // What draws a map; shading with it differs by a constant from shading with other six moments.
        let drawn = !name.starts_with("shade") && !name.contains("single");
        return drawn && ends(&["unorm10", "unorm10_x"]);
    }
    // Other storages change a constant.
    if OTHER_TECHNIQUES.iter().any(|other| name.contains(other)) {
        let blurred_alike = name.starts_with("blur") && !name.contains("logarithmic");
        return ends(&["float32", "unorm8", "lloyd_unorm16"]) && !blurred_alike;
    }
    if name.starts_with("blur") || name.starts_with("downsample") {
        return !name.contains("radius") && ends(&["unorm16", "unorm16_x"]);
    }
    if name.starts_with("debug_moments") {
        return name == "debug_moments_unorm16_validity";
    }
    name == "shade_hard_unorm16_mips" || !ends(&["_2", "_8", "_regions", "_mips", "_views"])
}

/// Techniques whose maps hold something else than four moments, or are read by other means.
const OTHER_TECHNIQUES: [&str; 6] = [
    "esm",
    "vsm",
    "convolution",
    "hausdorff4",
    "hamburger6",
    "pcf",
];

fn snapshot(name: &str) -> PathBuf {
    [
        env!("CARGO_MANIFEST_DIR"),
        "tests",
        "snapshots",
        &format!("{name}.wgsl"),
    ]
    .iter()
    .collect()
}

#[test]
fn every_linked_shader_equals_its_snapshot() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut names = BTreeSet::new();
    for variant in variants()
        .into_iter()
        .filter(|variant| is_kept(&variant.name))
    {
        let path = snapshot(&variant.name);
        names.insert(path.file_name().unwrap().to_owned());
        if update {
            std::fs::write(&path, &variant.wgsl).unwrap();
            continue;
        }
        let kept = std::fs::read_to_string(&path)
            .unwrap_or_default()
            .replace("\r\n", "\n");
        let difference = kept
            .lines()
            .zip(variant.wgsl.lines())
            .position(|(kept, new)| kept != new);
        let line = difference.unwrap_or(kept.lines().count().min(variant.wgsl.lines().count())) + 1;
        assert!(
            kept == variant.wgsl,
            "{} differs from the shader from line {line} on; if that is meant, run \
             `UPDATE_SNAPSHOTS=1 cargo test --test node_shaders` and look at the difference",
            path.display()
        );
    }
    let folder = snapshot("any").parent().unwrap().to_owned();
    for file in std::fs::read_dir(folder).unwrap() {
        let name = file.unwrap().file_name();
        assert!(
            names.contains(&name),
            "{} belongs to no shader; remove it",
            name.display()
        );
    }
}

#[test]
fn every_linked_shader_is_valid_on_every_backend_that_can_express_it() {
    for variant in variants() {
        let source = Source {
            name: &variant.name,
            text: &variant.wgsl,
        };
        let report = validate(source, &[], variant.profile)
            .unwrap_or_else(|error| panic!("{}: {error}", variant.name));
        let written: Vec<Backend> = report.written().collect();
        for backend in [Backend::SpirV, Backend::Hlsl, Backend::Msl] {
            assert!(
                written.contains(&backend),
                "{} on {backend:?}: {:?}",
                variant.name,
                report.outcome(backend)
            );
        }
    }
}

#[test]
fn a_storage_beyond_the_core_is_refused_there() {
    for variant in variants() {
        let source = Source {
            name: &variant.name,
            text: &variant.wgsl,
        };
        let refused = validate(source, &[], Profile::WebgpuCore).is_err();
        // Shading and showing read the map: an rgba16unorm texture that is sampled has no format in its type.
        let reads = ["shade", "debug"]
            .iter()
            .any(|node| variant.name.starts_with(node));
        let optional = ["16unorm", "<r16float", "<rg16float"];
        let stored = |format: &&str| variant.wgsl.contains(&format!("{format}, write>"));
        let stores = optional.iter().any(stored) && !reads;
        assert_eq!(refused, stores, "{}", variant.name);
    }
}

#[test]
fn the_texts_of_variants_differ() {
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    for variant in variants() {
        let before = texts.insert(variant.wgsl, variant.name.clone());
        assert_eq!(before, None, "{} repeats it", variant.name);
    }
}
