//! Techniques that a command line names, and what a graph is measured with in place of its own technique and storage.

use core::fmt;
use core::str::FromStr;

use moment_shadows::{
    Finite, MapEncoding, PcfTaps, Profile, Storage, Technique, ValueError, nearest,
};

use crate::error::LabError;
use crate::graph_file::GraphFile;
use crate::techniques::{self, described, label};

/// A technique with its storage.
#[derive(Clone, Debug, PartialEq)]
pub enum Candidate {
    /// The graph's own technique in another storage.
    Storage(Storage),
    /// A filterable technique.
    Filterable(MapEncoding),
    /// A technique that reads the plain depth map.
    ReadingDepth(Technique),
    /// Percentage-closer filtering with the graph's own kernel.
    PercentageCloser,
}

/// A technique as a command line gives it: with its settings for each storage, or percentage-closer filtering with the
/// graph's kernel.
#[derive(Clone, Debug, PartialEq)]
pub struct TechniqueChoice {
    /// In every storage that it can have, the one with the least error per bit first; a single one where it reads depth.
    candidates: Vec<Candidate>,
}

/// What percentage-closer filtering with the graph's kernel is called.
const PCF: &str = "pcf";

impl Candidate {
    /// Both references on the plain depth map, the binary test and percentage-closer filtering with the graph's kernel, and
    /// all filterable techniques in all of their storages.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let references = [
            Self::ReadingDepth(Technique::Binary),
            Self::PercentageCloser,
        ];
        let filterable = techniques::filterable().into_iter().map(Self::Filterable);
        references.into_iter().chain(filterable).collect()
    }

    /// The storage; none for techniques that read depth.
    #[must_use]
    pub fn storage(&self) -> Option<Storage> {
        match self {
            Self::Storage(storage) => Some(*storage),
            Self::Filterable(encoding) => Some(encoding.storage()),
            Self::ReadingDepth(_) | Self::PercentageCloser => None,
        }
    }

    /// Whether the graph reads the plain depth map with it.
    #[must_use]
    pub fn reads_depth(&self) -> bool {
        self.storage().is_none()
    }

    /// The smallest profile under which a device can write its map, and that offers what `profile` does.
    #[must_use]
    pub fn profile_with(&self, profile: Profile) -> Profile {
        let works = |profile: &Profile| match self {
            Self::Storage(storage) => storage.check(*profile).is_ok(),
            Self::Filterable(encoding) => encoding.check(*profile).is_ok(),
            Self::ReadingDepth(_) | Self::PercentageCloser => true,
        };
        Profile::ALL
            .into_iter()
            .skip_while(|smaller| *smaller != profile)
            .find(works)
            .unwrap_or(Profile::NativeAdapter)
    }

    /// The graph with it.
    pub fn graph(&self, file: &GraphFile) -> Result<GraphFile, LabError> {
        match self {
            Self::Storage(storage) => {
                GraphFile::parse(&file.name, file.text.clone(), Some(*storage))
            }
            Self::Filterable(encoding) => {
                file.with_technique(encoding.technique(), Some(encoding.storage()))
            }
            Self::ReadingDepth(technique) => file.with_technique(technique, None),
            Self::PercentageCloser => {
                // A map without a blur is compared texel by texel, and bilinearly in between.
                let weights = file
                    .kernel()?
                    .map_or(vec![1.0], |kernel| kernel.weights().to_vec());
                let weights = weights
                    .into_iter()
                    .map(|weight| Finite::new(weight).unwrap_or_default());
                let taps = PcfTaps::Weights(weights.collect());
                file.with_technique(&Technique::Pcf(taps), None)
            }
        }
    }

    fn technique(&self) -> Option<&Technique> {
        match self {
            Self::Filterable(encoding) => Some(encoding.technique()),
            Self::ReadingDepth(technique) => Some(technique),
            Self::Storage(_) | Self::PercentageCloser => None,
        }
    }
}

impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Storage(storage) => write!(f, "{storage}"),
            Self::Filterable(encoding) => {
                write!(
                    f,
                    "{} {}",
                    described(encoding.technique()),
                    encoding.storage()
                )
            }
            Self::ReadingDepth(technique) => f.write_str(&described(technique)),
            Self::PercentageCloser => f.write_str(PCF),
        }
    }
}

impl TechniqueChoice {
    /// In every storage that it can have, the one with the least error per bit first; a single one for a technique that
    /// reads depth.
    #[must_use]
    pub fn candidates(&self) -> &[Candidate] {
        &self.candidates
    }

    /// The candidate in a storage; in its best one if none is given. Techniques that read depth have no storage.
    pub fn in_storage(&self, storage: Option<Storage>) -> Result<Candidate, ValueError> {
        let best = &self.candidates[0];
        let Some(storage) = storage else {
            return Ok(best.clone());
        };
        let Candidate::Filterable(encoding) = best else {
            let message = format!(
                "the technique reads the plain depth map, which is not stored as {storage}; leave that out"
            );
            return Err(ValueError::new("storage", message));
        };
        let found = self
            .candidates
            .iter()
            .find(|it| it.storage() == Some(storage));
        match found {
            Some(found) => Ok(found.clone()),
            None => {
                MapEncoding::new(encoding.technique().clone(), storage).map(Candidate::Filterable)
            }
        }
    }

    /// A graph with the technique: in the storage that is `wished`, else in the graph's own where the technique has the same
    /// settings with it as with the one that it uses best, else in that.
    pub fn graph(&self, file: &GraphFile, wished: Option<Storage>) -> Result<GraphFile, LabError> {
        let own = file.encoding().map(|encoding| encoding.storage());
        let best = &self.candidates[0];
        let as_good = |it: &&Candidate| it.storage() == own && it.technique() == best.technique();
        let candidate = match wished {
            Some(_) => self
                .in_storage(wished)
                .map_err(|error| file.unsuitable(error.to_string()))?,
            None => self.candidates.iter().find(as_good).unwrap_or(best).clone(),
        };
        candidate.graph(file)
    }

    /// A technique with its settings. Exponents that are given have to be legal in one storage at least.
    fn of(technique: Technique) -> Result<Self, ValueError> {
        technique.check()?;
        let mut candidates = Vec::new();
        let mut refused = Ok(());
        for &storage in technique.row().storages {
            match MapEncoding::new(technique.clone(), storage) {
                Ok(encoding) => candidates.push(Candidate::Filterable(encoding)),
                Err(error) => refused = refused.and(Err(error)),
            }
        }
        if technique.reads_depth() {
            candidates.push(Candidate::ReadingDepth(technique));
        }
        if candidates.is_empty() {
            refused?;
        }
        Ok(Self { candidates })
    }
}

/// All techniques with usual settings, and with others that have a name.
fn known() -> Vec<Technique> {
    let mut all = Technique::examples();
    let variants: Vec<_> = all.iter().filter_map(techniques::variant).collect();
    all.extend(variants);
    all
}

impl FromStr for TechniqueChoice {
    type Err = String;

    /// A name, for the usual settings, or settings as in a graph file.
    fn from_str(text: &str) -> Result<Self, String> {
        let text = text.trim();
        if text == PCF {
            return Ok(Self {
                candidates: vec![Candidate::PercentageCloser],
            });
        }
        let known = known();
        let technique = if text.starts_with('{') {
            serde_json::from_str(text)
                .map_err(|error| format!("this is no technique as a graph file has it: {error}"))?
        } else if let Some(named) = known.iter().find(|technique| label(technique) == text) {
            named.clone()
        } else {
            let mut names: Vec<String> = known.iter().map(label).collect();
            names.push(PCF.to_owned());
            let nearest = nearest(text, names.iter().map(String::as_str));
            return Err(format!(
                "there is no technique '{text}'; the nearest are {nearest}, and settings can be given as JSON: \
                 {{\"esm\": {{\"exponent\": 40.0}}}}"
            ));
        };
        Self::of(technique).map_err(|error| error.to_string())
    }
}

/// All techniques where no choice is made; otherwise the chosen ones. In every storage, or in the one that is given, which
/// references that read depth do not have.
pub fn candidates(
    choices: &[TechniqueChoice],
    storage: Option<Storage>,
) -> Result<Vec<Candidate>, ValueError> {
    if choices.is_empty() {
        let mut all = Candidate::all();
        all.retain(|it| storage.is_none() || it.reads_depth() || it.storage() == storage);
        return Ok(all);
    }
    let mut chosen = Vec::new();
    for choice in choices {
        // Techniques that read depth have no storage that could be another.
        if storage.is_some() && !choice.candidates[0].reads_depth() {
            chosen.push(choice.in_storage(storage)?);
        } else {
            chosen.extend_from_slice(choice.candidates());
        }
    }
    Ok(chosen)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    #[test]
    fn every_name_is_a_technique_in_the_storages_of_its_settings() {
        let names: Vec<String> = known().iter().map(label).collect();
        for name in [
            "binary",
            "pcf_gaussian",
            "pcss",
            "esm",
            "evsm4",
            "lvsm_lloyd",
        ] {
            assert!(names.iter().any(|known| known == name), "{name}");
        }
        for name in names {
            let choice: TechniqueChoice = name.parse().unwrap();
            for candidate in choice.candidates() {
                assert_eq!(
                    choice.in_storage(candidate.storage()).as_ref(),
                    Ok(candidate)
                );
                assert_eq!(candidate.technique().map(label), Some(name.clone()));
            }
        }
    }

    #[test]
    fn a_storage_of_the_graph_gives_way_and_a_wished_one_does_not() {
        let graph = include_str!("../../hard_shadows.json");
        // Half precision has the least exponent; the usual one is worth another storage.
        for (name, of_graph, expected) in [
            ("evsm4", Storage::Unorm16, Storage::Float32),
            ("esm", Storage::Float16, Storage::Float32),
            ("vsm", Storage::Float16, Storage::Float16),
        ] {
            let file = GraphFile::parse("graph", graph.to_owned(), Some(of_graph)).unwrap();
            let choice: TechniqueChoice = name.parse().unwrap();
            let made = choice.graph(&file, None).unwrap().encoding().unwrap();
            assert_eq!(made.storage(), expected, "{name}");
            if name == "evsm4" {
                assert!(choice.graph(&file, Some(of_graph)).is_err());
            }
        }
    }
}
