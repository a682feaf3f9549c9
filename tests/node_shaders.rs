//! The linked text of every node's shader: valid under the profiles that it is for, and made of what its snapshot says.
//!
//! A snapshot holds what is generated: specialised constants, adapters of techniques, unrolled bodies; and of every other file the
//! names of what is linked, in order. `UPDATE_SNAPSHOTS=1 cargo test --test node_shaders` writes the snapshots anew.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use moment_shadows::{Backend, Profile, Source, ValidationOptions, validate};
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

/// Modules that are made by Rust code; the text of the others is a file.
const GENERATED: [&str; 9] = [
    "blur_texel",
    "blur_outputs",
    "map_encoding",
    "map_filtering",
    "shade_targets",
    "specialization",
    "technique",
    "technique_blockers",
    "technique_layer",
];

/// The name that a comment line gives to the part of a linked text that follows it.
fn file_name(line: &str) -> Option<&str> {
    let name = line.strip_prefix("// ")?;
    let part = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || "_/.".contains(c);
    (name.chars().all(part) && !name.ends_with("..")).then_some(name)
}

/// What a line defines at top level.
fn definition(line: &str) -> Option<&str> {
    let line = line
        .rsplit_once(") ")
        .filter(|_| line.starts_with('@'))
        .map_or(line, |(_, rest)| rest);
    let (kind, rest) = line.split_once([' ', '<'])?;
    if !["fn", "struct", "alias", "const", "override", "var"].contains(&kind) {
        return None;
    }
    let rest = rest
        .split_once("> ")
        .filter(|_| kind == "var")
        .map_or(rest, |(_, name)| name);
    let end = |c: char| !c.is_alphanumeric() && c != '_';
    rest.split(end).next().filter(|name| !name.is_empty())
}

/// What a snapshot holds of a linked text.
fn summary(wgsl: &str) -> String {
    let mut names = String::new();
    let mut generated = String::new();
    let mut is_generated = false;
    for line in wgsl.lines() {
        if let Some(name) = file_name(line) {
            is_generated = GENERATED.contains(&name);
            if is_generated {
                generated.push_str(&format!("// {name}\n"));
            } else {
                names.push_str(&format!("\n// {name}:"));
            }
        } else if is_generated {
            generated.push_str(&format!("{line}\n"));
        } else if let Some(name) = definition(line) {
            names.push_str(&format!(" {name}"));
        }
    }
    format!("// What is linked of files:{names}\n\n{generated}")
}

#[test]
fn every_linked_shader_equals_its_snapshot() {
    let update = std::env::var_os("UPDATE_SNAPSHOTS").is_some();
    let mut names = BTreeSet::new();
    let nodes = shaders::nodes().unwrap().into_iter();
    for variant in nodes.filter(|node| node.is_kept).map(|node| node.shader) {
        let path = snapshot(&variant.name);
        names.insert(path.file_name().unwrap().to_owned());
        let found = summary(&variant.wgsl);
        if update {
            std::fs::write(&path, found).unwrap();
            continue;
        }
        let kept = std::fs::read_to_string(&path)
            .unwrap_or_default()
            .replace("\r\n", "\n");
        let difference = kept
            .lines()
            .zip(found.lines())
            .position(|(kept, new)| kept != new);
        let line = difference.unwrap_or(kept.lines().count().min(found.lines().count())) + 1;
        assert!(
            kept == found,
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
        let report = validate(source, &under(variant.profile));
        assert!(report.is_valid(), "{}: {report}", variant.name);
        let written: Vec<Backend> = report.written().collect();
        for backend in [Backend::SpirV, Backend::Hlsl, Backend::Msl] {
            assert!(
                written.contains(&backend),
                "{} on {backend:?}: {:?}",
                variant.name,
                report.outcomes
            );
        }
    }
}

fn under(profile: Profile) -> ValidationOptions<'static> {
    ValidationOptions {
        profile,
        ..ValidationOptions::default()
    }
}

#[test]
fn a_storage_beyond_the_core_is_refused_there() {
    for variant in variants() {
        let source = Source {
            name: &variant.name,
            text: &variant.wgsl,
        };
        let refused = !validate(source, &under(Profile::WebgpuCore)).is_valid();
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

/// A variant's name without what its text does not depend on: row and column prefixes are sums of `u32` whatever the map
/// stores, and so is what the first pass of a blur packs that rounds inwards.
fn distinct(name: &str) -> String {
    // So does one whose map is written once.
    if name == "blur_resolved_packed32_x" {
        return "blur_inwards_x".to_owned();
    }
    // Along y a blur that resolves reads a map as others do, unless that is packed.
    let name = match name.strip_prefix("blur_resolved_") {
        Some(rest) if rest.ends_with("_y") => format!("blur_unrolled_radius_4_{rest}"),
        _ => name.to_owned(),
    };
    let prefixes = name.ends_with("_rows") || name.ends_with("_columns");
    let packs = name.starts_with("blur_inwards") && name.ends_with("_x");
    if !(name.starts_with("summed_area_table") && prefixes || packs) {
        return name;
    }
    let storages = ["_unorm16", "_float16", "_float32"];
    storages
        .iter()
        .fold(name, |name, storage| name.replace(storage, ""))
}

#[test]
fn the_texts_of_variants_differ() {
    let mut texts: BTreeMap<String, String> = BTreeMap::new();
    let mut names = BTreeSet::new();
    for variant in variants() {
        let name = distinct(&variant.name);
        assert!(names.insert(variant.name.clone()), "{}", variant.name);
        if let Some(before) = texts.insert(variant.wgsl, name.clone()) {
            assert_eq!(before, name, "{} repeats it", variant.name);
        }
    }
}
