//! The copy of the tree that has all faults, each of which is on where the environment says so.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::site::{ON, Site};

/// Where things are.
pub struct Places {
    /// The tree that is judged.
    pub root: PathBuf,
    /// Its copy with the faults.
    pub copy: PathBuf,
    pub target: PathBuf,
    /// Texts of faults in WGSL.
    pub texts: PathBuf,
    pub dropped: PathBuf,
    pub suite: PathBuf,
    pub results: PathBuf,
}

impl Places {
    pub fn new(root: PathBuf) -> Self {
        let work = root.join("target/mutants");
        Self {
            copy: work.join("tree"),
            target: work.join("build"),
            texts: work.join("texts"),
            dropped: work.join("dropped.json"),
            suite: work.join("suite.json"),
            results: root.join("check/mutants/results.jsonl"),
            root,
        }
    }
}

/// Where the planted faults lie in the files of the copy, by number.
type Planted = BTreeMap<String, Vec<(usize, Range<usize>)>>;

/// Makes the copy anew, with `sites` planted, the first of which is number 1. Files that stay the same are not touched.
pub fn plant(places: &Places, sites: &[Site]) -> io::Result<Planted> {
    let listed = Command::new("git")
        .args([
            "ls-files",
            "-z",
            "--cached",
            "--others",
            "--exclude-standard",
        ])
        .current_dir(&places.root)
        .output()?;
    let listed = String::from_utf8_lossy(&listed.stdout).into_owned();
    let mut by_file: BTreeMap<&str, Vec<(usize, &Site)>> = BTreeMap::new();
    for (index, site) in sites.iter().enumerate() {
        by_file
            .entry(&site.file)
            .or_default()
            .push((index + 1, site));
    }
    fs::create_dir_all(&places.texts)?;
    let mut planted = Planted::new();
    for file in listed.split('\0').filter(|file| !file.is_empty()) {
        let Ok(mut content) = fs::read(places.root.join(file)) else {
            continue;
        };
        if let Some(sites) = by_file.get(file) {
            let text = String::from_utf8_lossy(&content).into_owned();
            if file.ends_with(".wgsl") {
                for (number, site) in sites {
                    let original = &text[site.declaration.clone()];
                    let start = site.declaration.start;
                    let (before, after) = (
                        &original[..site.range.start - start],
                        &original[site.range.end - start..],
                    );
                    fs::write(places.texts.join(format!("{number}.original")), original)?;
                    fs::write(
                        places.texts.join(format!("{number}.fault")),
                        format!("{before}{}{after}", site.with),
                    )?;
                }
            } else {
                let (text, at) = with_faults(file, &text, sites);
                planted.insert(file.to_owned(), at);
                content = text.into_bytes();
            }
        }
        if let Some((_, changes)) = PATCHES.iter().find(|(patched, _)| *patched == file) {
            let mut text = String::from_utf8_lossy(&content).into_owned();
            for (from, to) in *changes {
                if text.matches(from).count() != 1 {
                    return Err(io::Error::other(format!(
                        "{file} does not have this once: {from}"
                    )));
                }
                text = text.replace(from, to);
            }
            content = text.into_bytes();
        }
        write(&places.copy.join(file), &content)?;
    }
    write(
        &places.copy.join("src/mutant.rs"),
        include_bytes!("../runtime/mutant.rs"),
    )?;
    Ok(planted)
}

/// Where the core asks which fault is on.
const PATCHES: [(&str, &[(&str, &str)]); 3] = [
    ("src/lib.rs", &[("\nmod area_light;", "\n#[doc(hidden)]\npub mod mutant;\nmod area_light;")]),
    (
        "src/link/module.rs",
        &[("edited(it).unwrap_or(*it))", "edited(it).unwrap_or(*it)).map(|it| Module { source: crate::mutant::text(it.source), ..it })")],
    ),
    (
        "src/link/mod.rs",
        &[
            (
                "pub fn link(source: Source<'_>, modules: &[Source<'_>]) -> Result<Linked, ShaderError> {",
                "pub fn link(source: Source<'_>, modules: &[Source<'_>]) -> Result<Linked, ShaderError> {
    let faulty = |source: Source<'_>| -> (String, String) { (source.name.to_owned(), crate::mutant::text(source.text).to_owned()) };
    let (root, others) = (faulty(source), modules.iter().map(|it| faulty(*it)).collect::<Vec<_>>());
    let source = Source { name: &root.0, text: &root.1 };
    let modules: Vec<_> = others.iter().map(|it| Source { name: &it.0, text: &it.1 }).collect();
    let modules = modules.as_slice();",
            ),
            ("    Ok(Linked::join(&files))", "    let linked = Linked::join(&files);\n    crate::mutant::linked(linked.wgsl());\n    Ok(linked)"),
        ],
    ),
];

fn write(path: &Path, content: &[u8]) -> io::Result<()> {
    if fs::read(path).is_ok_and(|is| is == content) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder)?;
    }
    fs::write(path, content)
}

/// A file of Rust with its faults, and where they are.
fn with_faults(
    file: &str,
    text: &str,
    sites: &[(usize, &Site)],
) -> (String, Vec<(usize, Range<usize>)>) {
    let root = if file.starts_with("src/") {
        "crate"
    } else {
        "::moment_shadows"
    };
    let mut sites = sites.to_vec();
    sites.sort_by_key(|(_, site)| site.range.start);
    let (mut result, mut planted, mut end) = (String::new(), Vec::new(), 0);
    for (number, site) in sites {
        result += &text[end..site.range.start];
        let start = result.len();
        result += &site
            .with
            .replace(ON, &format!("{root}::mutant::on({number})"));
        planted.push((number, start..result.len()));
        end = site.range.end;
    }
    (result + &text[end..], planted)
}

/// Cargo in the copy.
pub fn cargo(places: &Places) -> Command {
    let mut command = Command::new("cargo");
    command
        .current_dir(&places.copy)
        .env("CARGO_TARGET_DIR", &places.target);
    command
}

/// The numbers of the faults that do not compile.
pub fn refused(places: &Places, planted: &Planted) -> io::Result<BTreeSet<usize>> {
    let output = cargo(places)
        .args([
            "check",
            "--release",
            "--locked",
            "--workspace",
            "--lib",
            "--bins",
            "--message-format=json",
        ])
        .stderr(Stdio::inherit())
        .output()?;
    let mut refused = BTreeSet::new();
    for line in output.stdout.split(|byte| *byte == b'\n') {
        let Ok(line) = serde_json::from_slice::<Value>(line) else {
            continue;
        };
        let message = &line["message"];
        if message["level"] != "error" {
            continue;
        }
        let spans = message["spans"].as_array().into_iter().flatten();
        for span in spans {
            let file = span["file_name"].as_str().unwrap_or_default();
            let bytes = ["byte_start", "byte_end"]
                .map(|key| span[key].as_u64().unwrap_or_default() as usize);
            for (number, at) in planted.get(file).into_iter().flatten() {
                if at.start < bytes[1] && bytes[0] < at.end {
                    refused.insert(*number);
                }
            }
        }
        if refused.is_empty()
            && message["spans"]
                .as_array()
                .is_some_and(|spans| !spans.is_empty())
        {
            println!("{}", message["rendered"].as_str().unwrap_or_default());
        }
    }
    if refused.is_empty() && !output.status.success() {
        return Err(io::Error::other(
            "the copy does not compile, and no fault is the reason",
        ));
    }
    Ok(refused)
}
