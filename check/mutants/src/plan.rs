//! Which faults are planted: a sample that the seed alone decides.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::Path;

use crate::site::{Site, hash};
use crate::{rust, wgsl};

/// One kind of place, and how many of its faults are judged.
pub struct Share {
    pub name: &'static str,
    pub judged: usize,
    holds: fn(&str) -> bool,
}

/// In proportion to code: half of it is WGSL, the rest both crates alike.
pub const SHARES: [Share; 3] = [
    Share {
        name: "WGSL",
        judged: 150,
        holds: |file| file.ends_with(".wgsl"),
    },
    Share {
        name: "src",
        judged: 75,
        holds: |file| file.ends_with(".rs") && file.starts_with("src/"),
    },
    Share {
        name: "graph/src",
        judged: 75,
        holds: |file| file.ends_with(".rs") && file.starts_with("graph/"),
    },
];

/// More are planted than are judged, since some turn out not to compile.
const PLANTED: f64 = 1.5;

/// What is planted in `root`, in the order in which it is judged: each share's faults evenly, so that a part of them is a fair sample.
pub fn plan(root: &Path, seed: u64, dropped: &BTreeSet<String>) -> io::Result<Vec<Site>> {
    let mut files = Vec::new();
    for folder in ["wgsl", "src", "graph/src"] {
        list(root, Path::new(folder), &mut files)?;
    }
    files.sort();
    let texts: Vec<_> = files
        .iter()
        .map(|file| fs::read_to_string(root.join(file)))
        .collect::<Result<_, _>>()?;
    let all = || files.iter().zip(&texts);
    let host: String = all()
        .filter(|(file, _)| file.ends_with(".rs"))
        .map(|(_, text)| text.as_str())
        .collect();
    let words: BTreeSet<_> = host
        .split(|c: char| !c.is_alphanumeric() && c != '_')
        .collect();
    let shaders: String = all()
        .filter(|(file, _)| file.ends_with(".wgsl"))
        .map(|(_, text)| text.as_str())
        .collect();
    let mut sites = Vec::new();
    for (file, text) in all() {
        if file.ends_with(".wgsl") {
            let of = wgsl::sites(file, text, seed, |name| words.contains(name));
            // A declaration is found by its text.
            let is_single =
                |site: &Site| shaders.matches(&text[site.declaration.clone()]).count() == 1;
            sites.extend(of.into_iter().filter(is_single));
        } else {
            sites.extend(
                rust::sites(file, text, seed)
                    .map_err(|error| io::Error::other(format!("{file}: {error}")))?,
            );
        }
    }
    let mut same = BTreeMap::new();
    for site in &mut sites {
        let before = same.entry(site.key()).or_insert(0);
        site.nth = *before;
        *before += 1;
    }
    sites.retain(|site| !dropped.contains(&site.key()));
    sites.sort_by_key(|site| (hash(&site.key(), seed), site.key()));
    let mut planted: Vec<(f64, Site)> = Vec::new();
    for share in &SHARES {
        let limit = (share.judged as f64 * PLANTED) as usize;
        let mut of: Vec<Site> = Vec::new();
        for site in sites.iter().filter(|site| (share.holds)(&site.file)) {
            // In Rust two faults cannot overlap; in WGSL one at a time is there.
            let overlaps = |other: &Site| {
                other.file == site.file
                    && other.range.start < site.range.end.max(site.range.start + 1)
                    && site.range.start < other.range.end.max(other.range.start + 1)
            };
            if of.len() < limit && !of.iter().any(overlaps) {
                of.push(site.clone());
            }
        }
        println!(
            "{}: {} places, {} planted",
            share.name,
            sites
                .iter()
                .filter(|site| (share.holds)(&site.file))
                .count(),
            of.len()
        );
        planted.extend(
            of.into_iter()
                .enumerate()
                .map(|(index, site)| (index as f64 / share.judged as f64, site)),
        );
    }
    planted.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    Ok(planted.into_iter().map(|(_, site)| site).collect())
}

/// The share of a file.
pub fn share_of(file: &str) -> usize {
    SHARES
        .iter()
        .position(|share| (share.holds)(file))
        .unwrap_or_default()
}

fn list(root: &Path, folder: &Path, files: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(root.join(folder))? {
        let entry = entry?;
        let path = folder.join(entry.file_name());
        if entry.file_type()?.is_dir() {
            list(root, &path, files)?;
        } else if path
            .extension()
            .is_some_and(|it| it == "rs" || it == "wgsl")
        {
            files.push(path.to_string_lossy().into_owned());
        }
    }
    Ok(())
}
