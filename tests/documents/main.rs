//! What documents say of the tree is so: paths, modules, techniques.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod best;
mod claims;
mod graph_file;
mod links;
mod plan;
mod scattering_ways;
mod schema;
mod wgsl;

use std::collections::BTreeSet;
use std::path::Path;

use moment_shadows::modules;
use moment_shadows_lab::scene::EXTENSIONS;
use moment_shadows_lab::techniques::{filterable, reading_depth};

pub(crate) fn read(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Compares a file that is generated with what it should be; with `UPDATE_DOCUMENTS` set it is written instead.
pub(crate) fn kept(file: &str, expected: &str) {
    if std::env::var_os("UPDATE_DOCUMENTS").is_some() {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
        std::fs::write(path, expected).unwrap();
        return;
    }
    let found = read(file).replace("\r\n", "\n");
    let line = found
        .lines()
        .zip(expected.lines())
        .position(|(a, b)| a != b);
    assert!(
        found == expected,
        "{file} differs from what the code says from line {} on; run \
         `UPDATE_DOCUMENTS=1 cargo test --release --test documents` and look at the difference",
        line.unwrap_or_default() + 1
    );
}

/// What stands between backticks.
fn quoted(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

/// The names of all techniques.
fn techniques() -> BTreeSet<&'static str> {
    let filterable = filterable().into_iter();
    let names = filterable.map(|encoding| encoding.technique().name());
    names
        .chain(reading_depth().iter().map(|technique| technique.name()))
        .collect()
}

#[test]
fn paths_are_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut missing = Vec::new();
    for file in ["docs/architecture.md", "CONTRIBUTING.md"] {
        for path in quoted(&read(file)) {
            let is_path = path.contains('/') && !path.contains([' ', '<', '$', ':']);
            if is_path && !path.starts_with("./") && !root.join(path).exists() {
                missing.push(format!("{file}: {path}"));
            }
        }
    }
    assert_eq!(missing, Vec::<String>::new());
}

#[test]
fn the_walk_opens_no_file_twice() {
    let text = read("docs/architecture.md");
    let walk = text.split("## The walk of a texel").nth(1).unwrap();
    let walk = walk.split("\n## ").next().unwrap();
    let steps: Vec<&str> = walk
        .lines()
        .filter(|line| line.starts_with(|first: char| first.is_ascii_digit()))
        .map(|line| quoted(line)[0])
        .collect();
    let distinct: BTreeSet<_> = steps.iter().collect();
    assert_eq!(distinct.len(), steps.len(), "{steps:?}");
    assert!((1..=14).contains(&steps.len()), "{} files", steps.len());
}

#[test]
fn every_module_that_is_named_exists_and_every_folder_is_listed() {
    let text = read("docs/architecture.md");
    let known: BTreeSet<String> = modules()
        .iter()
        .map(|module| format!("{}::{}", module.folder, module.name))
        .collect();
    let folders: BTreeSet<&str> = modules().iter().map(|module| module.folder).collect();
    for name in quoted(&text) {
        let folder = name.split("::").next().unwrap();
        if name.contains("::") && folders.contains(folder) {
            assert!(known.contains(name), "there is no module {name}");
        }
    }
    for folder in folders {
        assert!(
            text.contains(&format!("`wgsl/{folder}`")),
            "{folder} is not listed"
        );
    }
}

#[test]
fn every_technique_is_explained_and_every_abbreviation_is_listed() {
    let modules: BTreeSet<&str> = modules().iter().map(|module| module.name).collect();
    let names_in = |file| -> BTreeSet<String> {
        let text = read(file);
        quoted(&text).into_iter().map(str::to_owned).collect()
    };
    let explained = names_in("docs/techniques/README.md");
    let listed = names_in("docs/architecture.md");
    for technique in techniques() {
        assert!(
            explained.contains(technique),
            "{technique} is not explained"
        );
        let known = modules.contains(technique) || listed.contains(technique);
        assert!(known, "the module of {technique} is not listed");
    }
}

#[test]
fn the_table_of_techniques_says_what_rows_say() {
    let text = read("docs/techniques/README.md");
    let rows = text.lines().filter(|line| line.starts_with("| `"));
    let cells: Vec<Vec<&str>> = rows
        .map(|row| row.split('|').map(str::trim).collect())
        .collect();
    for encoding in filterable() {
        let row = encoding.technique().row();
        let named = |cells: &&Vec<&str>| quoted(cells[1]).contains(&row.name);
        let of_it = cells.iter().find(named);
        let cells = of_it.unwrap_or_else(|| panic!("{} is not in the table", row.name));
        let planes = cells[2].split(' ').next().unwrap();
        assert_eq!(planes, row.planes.to_string(), "{}", row.name);
        let said: BTreeSet<&str> = cells[4].split(", ").collect();
        let held: BTreeSet<&str> = row.storages.iter().map(|storage| storage.name()).collect();
        assert_eq!(said, held, "{}", row.name);
    }
}

#[test]
fn the_table_of_extensions_is_that_of_the_code() {
    let text = read("docs/instrument.md");
    let mut table = "| extensions of glTF | what becomes of them |\n|---|---|\n".to_owned();
    for row in &EXTENSIONS {
        table += &format!("| `{}` | {} |\n", row.names.join("`, `"), row.what);
    }
    assert!(text.contains(&table), "docs/instrument.md lacks\n{table}");
}
