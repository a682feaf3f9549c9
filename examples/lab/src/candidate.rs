//! What a graph is measured with in place of its own technique and storage.

use moment_shadows::{
    Finite, MapEncoding, PcfTaps, Profile, Storage, Technique, TechniqueError, nearest,
};

use crate::error::LabError;
use crate::graph_file::GraphFile;
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

/// A technique as a command line names it, in every storage that it can have.
#[derive(Clone, Debug, PartialEq)]
pub struct TechniqueChoice {
    /// One per storage, the one with the least error per bit first; a single one for a technique that reads depth.
    pub candidates: Vec<Candidate>,
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
    /// The technique of a name, with usual settings for each storage, or of an object as in graph files.
    pub fn parse(text: &str) -> Result<Self, String> {
        let candidates = if text.trim_start().starts_with('{') {
            let technique: Technique = serde_json::from_str(text)
                .map_err(|error| format!("it is no technique: {error}"))?;
            given(&technique).map_err(|error| error.to_string())?
        } else {
            named(text)
        };
        if candidates.is_empty() {
            let all = names();
            let near = nearest(text, all.iter().map(String::as_str));
            return Err(format!(
                "there is no technique '{text}'; the nearest are {near}"
            ));
        }
        Ok(Self { candidates })
    }

    /// The one in a storage; in its best one if none is given.
    pub fn in_storage(&self, storage: Option<Storage>) -> Result<Candidate, LabError> {
        let wanted = |candidate: &&Candidate| {
            storage.is_none() || candidate.reads_depth() || candidate.storage() == storage
        };
        let found = self.candidates.iter().find(wanted).cloned();
        found.ok_or_else(|| LabError::NoStorage {
            asked: storage.map_or("none", Storage::name),
            legal: self
                .candidates
                .iter()
                .filter_map(Candidate::storage)
                .map(Storage::name)
                .collect::<Vec<_>>()
                .join(" or "),
        })
    }
}

/// All techniques where no choice is made; otherwise the chosen ones. In every storage, or in the one that is given, which
/// references that read depth do not have.
pub fn candidates(
    choices: &[TechniqueChoice],
    storage: Option<Storage>,
) -> Result<Vec<Candidate>, LabError> {
    if choices.is_empty() {
        let mut all = Candidate::all();
        all.retain(|it| storage.is_none() || it.reads_depth() || it.storage() == storage);
        return Ok(all);
    }
    let mut chosen = Vec::new();
    for choice in choices {
        match storage {
            Some(_) => chosen.push(choice.in_storage(storage)?),
            None => chosen.extend(choice.candidates.iter().cloned()),
        }
    }
    Ok(chosen)
}

/// In every storage in which its settings are legal, if there is one.
fn given(technique: &Technique) -> Result<Vec<Candidate>, TechniqueError> {
    technique.check()?;
    if technique.reads_depth() {
        return Ok(vec![Candidate::ReadingDepth(technique.clone())]);
    }
    let mut candidates = Vec::new();
    let mut refused = None;
    for &storage in technique.storages() {
        match MapEncoding::new(technique.clone(), storage) {
            Ok(encoding) => candidates.push(Candidate::Filterable(encoding)),
            Err(error) => refused = refused.or(Some(error)),
        }
    }
    match refused {
        Some(error) if candidates.is_empty() => Err(error),
        _ => Ok(candidates),
    }
}

/// What percentage-closer filtering with the graph's kernel is called.
const PCF: &str = "pcf";

fn named(name: &str) -> Vec<Candidate> {
    if name == PCF {
        return vec![Candidate::PercentageCloser];
    }
    let mut filterable = techniques::filterable();
    filterable.retain(|encoding| techniques::label(encoding.technique()) == name);
    let place = |encoding: &MapEncoding| {
        let storages = encoding.technique().storages();
        storages
            .iter()
            .position(|&storage| storage == encoding.storage())
    };
    filterable.sort_by_key(place);
    let reading = techniques::reading_depth().into_iter();
    let reading = reading.filter(|technique| techniques::label(technique) == name);
    let filterable = filterable.into_iter().map(Candidate::Filterable);
    filterable
        .chain(reading.map(Candidate::ReadingDepth))
        .collect()
}

/// All names of techniques.
fn names() -> Vec<String> {
    let filterable = techniques::filterable();
    let filterable = filterable
        .iter()
        .map(|encoding| techniques::label(encoding.technique()));
    let reading = techniques::reading_depth();
    let reading = reading.iter().map(techniques::label);
    filterable.chain(reading).chain([PCF.to_owned()]).collect()
}
