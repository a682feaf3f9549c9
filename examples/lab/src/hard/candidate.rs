//! What is compared: graphs with names.

use moment_shadows::Storage;

use crate::candidate::TechniqueChoice;
use crate::error::LabError;
use crate::graph_file::GraphFile;

/// The chain of resolve, blur (9x9, Gaussian) and shading.
const GRAPH: &str = include_str!("../../../hard_shadows.json");

/// Filterable maps of 64 bits per texel, four moments first.
const MAPS: [(&str, Storage); 3] = [
    ("hamburger4", Storage::Unorm16),
    ("hamburger4", Storage::Packed64),
    ("evsm4", Storage::Float16),
];

/// What compares the plain depth map: the kernel of the graph, and a box of 5 x 5 taps.
const TESTS: [(&str, &str); 2] = [
    ("pcf_gaussian", "9x9 comparisons in the shader"),
    ("pcf_hardware", "25 taps of a comparison sampler"),
];

/// A graph from the imports `light_depth` and `camera_depth` to the output `shadow_intensity`.
#[derive(Debug)]
pub struct HardCandidate {
    /// What tables call it.
    pub name: String,
    /// The graph.
    pub file: GraphFile,
}

/// What all candidates are made from, and whose kernel they approximate.
pub(super) fn graph() -> Result<GraphFile, LabError> {
    GraphFile::parse("hard_shadows.json", GRAPH.to_owned(), None)
}

/// Each map with a node that resolves, and resolved by the blur; the same kernel in the shader; 25 comparisons by a sampler.
pub fn candidates() -> Result<Vec<HardCandidate>, LabError> {
    let apart = graph()?;
    let joined = apart.resolved_by_the_blur()?;
    let chosen = |name: &str| -> Result<TechniqueChoice, LabError> {
        name.parse().map_err(LabError::refused)
    };
    let mut all = Vec::new();
    for (technique, storage) in MAPS {
        let choice = chosen(technique)?;
        for (file, how) in [(&apart, ""), (&joined, ", resolved by the blur")] {
            let name = format!("{technique} {storage}{how}");
            all.push((name, choice.graph(file, Some(storage))?));
        }
    }
    for (technique, name) in TESTS {
        let graph = chosen(technique)?.graph(&apart, None)?;
        all.push((name.to_owned(), graph));
    }
    let candidates = all.into_iter().map(|(name, file)| {
        let file = file.in_single_precision()?;
        Ok(HardCandidate { name, file })
    });
    candidates.collect()
}
