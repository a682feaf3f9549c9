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
use moment_shadows_lab::shaders::{self, Shader};

fn variants() -> Vec<Shader> {
    let nodes = shaders::nodes().unwrap();
    nodes.into_iter().map(|node| node.shader).collect()
}

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
    let nodes = shaders::nodes().unwrap().into_iter();
    for variant in nodes.filter(|node| node.is_kept).map(|node| node.shader) {
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
