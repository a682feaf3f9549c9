//! What a graph is measured with in place of its own technique and storage.

use core::str::FromStr;

use moment_shadows::{Finite, MapEncoding, PcfTaps, Profile, Storage, Technique, ValueError};

use crate::error::LabError;
use crate::graph_file::GraphFile;
use crate::technique_argument::{TechniqueArgument, TechniqueArgumentError};
use crate::techniques;

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

/// What a command line asks to be measured.
#[derive(Clone, Debug, PartialEq)]
pub enum TechniqueChoice {
    /// Percentage-closer filtering with the graph's own kernel: `pcf`.
    PercentageCloser,
    /// Any other technique.
    Technique(TechniqueArgument),
}

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
        matches!(self, Self::ReadingDepth(_) | Self::PercentageCloser)
    }

    /// The smallest profile under which a device can write its map, and that offers what `profile` does.
    #[must_use]
    pub fn profile_with(&self, profile: Profile) -> Profile {
        let works = |profile: &Profile| match self {
            Self::Storage(storage) => storage.check(*profile).is_ok(),
            Self::Filterable(encoding) => encoding.check(*profile).is_ok(),
            Self::ReadingDepth(_) | Self::PercentageCloser => true,
        };
        let profiles = [Profile::WebgpuCore, Profile::Native, Profile::NativeAdapter];
        profiles
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
}

impl TechniqueChoice {
    /// In every storage that it can have, the one with the least error per bit first; a single one for a technique that
    /// reads depth.
    #[must_use]
    pub fn candidates(&self) -> Vec<Candidate> {
        match self {
            Self::PercentageCloser => vec![Candidate::PercentageCloser],
            Self::Technique(argument) => {
                let storages = argument.storages().into_iter();
                storages
                    .filter_map(|storage| self.in_storage(storage).ok())
                    .collect()
            }
        }
    }

    /// The candidate in a storage; in its best one if none is given. Techniques that read depth have no storage.
    pub fn in_storage(&self, storage: Option<Storage>) -> Result<Candidate, ValueError> {
        let Self::Technique(argument) = self else {
            return Ok(Candidate::PercentageCloser);
        };
        let (technique, storage) = argument.resolve(storage, None)?;
        Ok(match storage {
            Some(storage) => Candidate::Filterable(MapEncoding::new(technique, storage)?),
            None => Candidate::ReadingDepth(technique),
        })
    }
}

impl FromStr for TechniqueChoice {
    type Err = TechniqueArgumentError;

    fn from_str(text: &str) -> Result<Self, TechniqueArgumentError> {
        if text.trim() == PCF {
            return Ok(Self::PercentageCloser);
        }
        let choice = Self::Technique(text.parse()?);
        // Exponents belong to a storage: they are legal in one at least.
        choice.in_storage(None)?;
        Ok(choice)
    }
}

/// What percentage-closer filtering with the graph's kernel is called.
const PCF: &str = "pcf";

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
        match storage {
            Some(_) => chosen.push(choice.in_storage(storage)?),
            None => chosen.extend(choice.candidates()),
        }
    }
    Ok(chosen)
}
