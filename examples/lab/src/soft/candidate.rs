//! Techniques that are compared: graphs with names.

use std::path::Path;
use std::str::FromStr;

use moment_shadows::Technique;

use crate::error::LabError;
use crate::graph_file::GraphFile;

/// The chain of resolve, blur (9x9, Gaussian) and shading.
const HARD: &str = include_str!("../../../hard_shadows.json");

/// The chain of resolve, summed-area table and shading.
const SOFT: &str = include_str!("../../../soft_shadows.json");

/// Taps of search and filter of percentage closer soft shadows.
const TAPS: [(&str, u32, u32); 3] = [
    ("pcss 9x9", 81, 81),
    ("pcss 15x15", 225, 225),
    ("pcss 32+64", 32, 64),
];

/// A technique: a graph from the imports `light_depth` and `camera_depth` to the output `shadow_intensity`. Every parameter
/// block of the library's nodes is filled for the light and its size.
#[derive(Debug)]
pub struct SoftCandidate {
    /// What tables and files call it.
    pub name: String,
    /// The graph.
    pub file: GraphFile,
}

/// Hard moment shadows, percentage closer soft shadows with 9x9, 15x15 and 32 + 64 taps, moment soft shadows with four and two
/// moments, and the graphs that are given.
pub fn candidates(given: &[NamedGraph]) -> Result<Vec<SoftCandidate>, LabError> {
    let hard = GraphFile::parse("hard_shadows.json", HARD.to_owned(), None)?;
    let soft = GraphFile::parse("soft_shadows.json", SOFT.to_owned(), None)?;
    let mut all = Vec::new();
    for (name, search_taps, filter_taps) in TAPS {
        let technique = Technique::Pcss {
            search_taps,
            filter_taps,
        };
        all.push((name.to_owned(), hard.with_technique(&technique, None)?));
    }
    all.insert(0, ("hard".to_owned(), hard));
    for (name, technique) in [
        ("moment soft", Technique::Hamburger4),
        ("variance soft", Technique::Vsm),
    ] {
        all.push((name.to_owned(), soft.with_technique(&technique, None)?));
    }
    for NamedGraph { name, path } in given {
        all.push((name.clone(), GraphFile::read(Path::new(path), None)?));
    }
    let candidates = all.into_iter().map(|(name, file)| {
        let file = file.in_single_precision()?;
        Ok(SoftCandidate { name, file })
    });
    candidates.collect()
}

/// A graph file that a command line adds to the candidates: `NAME=FILE`, or a file that is its own name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedGraph {
    /// What to call it.
    pub name: String,
    /// The file.
    pub path: String,
}

impl FromStr for NamedGraph {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let stem = || {
            Path::new(text)
                .file_stem()
                .map(|stem| stem.to_string_lossy().into_owned())
        };
        let (name, path) = match text.split_once('=') {
            Some((name, path)) => (name.to_owned(), path),
            None => (stem().unwrap_or_default(), text),
        };
        if name.is_empty() || path.is_empty() {
            return Err(format!(
                "'{text}' is no NAME=FILE; give a graph file with a name"
            ));
        }
        Ok(Self {
            name,
            path: path.to_owned(),
        })
    }
}
