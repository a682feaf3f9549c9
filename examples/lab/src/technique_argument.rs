//! A technique as a command line gives it: a name, for the usual settings, or its settings as in a graph file.

use std::str::FromStr;

use moment_shadows::{LayerSplits, MapEncoding, Storage, Technique, ValueError, nearest};

use crate::techniques;

/// A technique with its settings, or with the usual ones for whatever storage it gets.
#[derive(Clone, Debug, PartialEq)]
pub enum TechniqueArgument {
    /// The usual settings under a name of [`names`].
    Usual(String),
    /// A technique with these settings.
    Given(Technique),
}

/// Text that is not a technique.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TechniqueArgumentError {
    /// A name that no technique has.
    #[error(
        "there is no technique '{name}'; the nearest are {nearest}, and settings can be given as JSON: \
         {{\"esm\": {{\"exponent\": 40.0}}}}"
    )]
    Unknown {
        /// What was given.
        name: String,
        /// Names like it.
        nearest: String,
    },
    /// JSON that is not a technique.
    #[error("this is no technique as a graph file has it: {reason}")]
    Json {
        /// What the parser says.
        reason: String,
    },
    /// Settings out of their ranges.
    #[error(transparent)]
    Settings(#[from] ValueError),
}

/// The names of all techniques with usual settings.
#[must_use]
pub fn names() -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let usual = usual().into_iter().map(|(technique, _)| technique);
    for technique in usual.chain(techniques::reading_depth()) {
        let name = techniques::label(&technique);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Filterable techniques with the storages that their settings suit.
fn usual() -> Vec<(Technique, Storage)> {
    let mut all = Vec::new();
    for encoding in techniques::filterable() {
        let (technique, storage) = (encoding.technique().clone(), encoding.storage());
        let variant = match &technique {
            Technique::Lvsm {
                layers, overlap, ..
            } => Some(Technique::Lvsm {
                layers: *layers,
                overlap: *overlap,
                splits: LayerSplits::Lloyd,
            }),
            Technique::Convolution { terms, .. } => Some(Technique::Convolution {
                terms: *terms,
                lower_bound: false,
            }),
            _ => None,
        };
        all.push((technique, storage));
        all.extend(variant.map(|variant| (variant, storage)));
    }
    all
}

impl TechniqueArgument {
    /// The technique and its map's storage: `wished`, else the graph's own where the technique has the same settings with
    /// it, else the one that it uses best. Without a storage where it reads the plain depth map.
    pub fn resolve(
        &self,
        wished: Option<Storage>,
        of_graph: Option<Storage>,
    ) -> Result<(Technique, Option<Storage>), ValueError> {
        let best = self.with_settings_for(None);
        if best.reads_depth() {
            return Ok((best, None));
        }
        let as_good = |storage: &Storage| {
            self.with_settings_for(Some(*storage)) == best
                && MapEncoding::new(best.clone(), *storage).is_ok()
        };
        let storage = wished
            .or(of_graph.filter(as_good))
            .or(best.storages().iter().copied().find(as_good))
            .or(best.storages().first().copied())
            .unwrap_or(Storage::Float32);
        let technique = self.with_settings_for(Some(storage));
        MapEncoding::new(technique.clone(), storage)?;
        Ok((technique, Some(storage)))
    }

    /// The storages that it can be measured with; one without a storage where it reads the plain depth map.
    #[must_use]
    pub fn storages(&self) -> Vec<Option<Storage>> {
        let technique = self.with_settings_for(None);
        let fits = |&storage: &Storage| self.resolve(Some(storage), None).is_ok();
        let legal = technique.storages().iter().copied();
        match technique.reads_depth() {
            true => vec![None],
            false => legal.filter(fits).map(Some).collect(),
        }
    }

    /// The settings for a storage, or for the one that the technique uses best.
    fn with_settings_for(&self, storage: Option<Storage>) -> Technique {
        let name = match self {
            TechniqueArgument::Given(technique) => return technique.clone(),
            TechniqueArgument::Usual(name) => name,
        };
        let named = |technique: &Technique| techniques::label(technique) == *name;
        let mut filterable: Vec<(Technique, Storage)> = usual();
        filterable.retain(|(technique, _)| named(technique));
        let of_storage = |storage: Storage| filterable.iter().find(|(_, of)| *of == storage);
        // All settings of a name are those of one technique, whose storages do not depend on them.
        let best = filterable
            .first()
            .and_then(|(technique, _)| technique.storages().iter().find_map(|&of| of_storage(of)));
        match storage.and_then(of_storage).or(best) {
            Some((technique, _)) => technique.clone(),
            // A name was parsed, so it is one of these.
            None => techniques::reading_depth()
                .into_iter()
                .find(named)
                .unwrap_or_default(),
        }
    }
}

impl FromStr for TechniqueArgument {
    type Err = TechniqueArgumentError;

    fn from_str(text: &str) -> Result<Self, TechniqueArgumentError> {
        let text = text.trim();
        if text.starts_with('{') {
            let technique: Technique =
                serde_json::from_str(text).map_err(|error| TechniqueArgumentError::Json {
                    reason: error.to_string(),
                })?;
            technique.check()?;
            return Ok(TechniqueArgument::Given(technique));
        }
        let names = names();
        if names.iter().any(|name| name == text) {
            return Ok(TechniqueArgument::Usual(text.to_owned()));
        }
        Err(TechniqueArgumentError::Unknown {
            name: text.to_owned(),
            nearest: nearest(text, names.iter().map(String::as_str)),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_a_technique_with_legal_settings() {
        let names = names();
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
            let argument: Result<TechniqueArgument, _> = name.parse();
            let argument = argument.unwrap_or(TechniqueArgument::Usual(String::new()));
            for storage in argument.storages() {
                let resolved = argument.resolve(storage, None);
                let label = resolved
                    .as_ref()
                    .map(|(technique, _)| techniques::label(technique));
                assert_eq!(label, Ok(name.clone()), "{storage:?}");
                assert_eq!(resolved.map(|(_, used)| used), Ok(storage));
            }
        }
    }

    #[test]
    fn a_storage_of_the_graph_gives_way_and_a_wished_one_does_not() {
        let evsm = TechniqueArgument::Usual("evsm4".to_owned());
        let given = evsm.resolve(None, Some(Storage::Unorm16));
        assert_eq!(
            given.map(|(_, storage)| storage),
            Ok(Some(Storage::Float32))
        );
        let refused = evsm.resolve(Some(Storage::Unorm16), None);
        assert_eq!(refused.map_err(|error| error.name), Err("storage"));
        // Half precision has the least exponent; the usual one is worth another storage.
        for (name, of_graph, expected) in [
            ("esm", Storage::Float16, Storage::Float32),
            ("vsm", Storage::Float16, Storage::Float16),
        ] {
            let resolved = TechniqueArgument::Usual(name.to_owned()).resolve(None, Some(of_graph));
            assert_eq!(resolved.map(|(_, storage)| storage), Ok(Some(expected)));
        }
    }

    #[test]
    fn what_is_no_technique_is_an_error_with_a_next_step() {
        let error = |text: &str| text.parse::<TechniqueArgument>().err();
        assert!(matches!(
            error("evsm"),
            Some(TechniqueArgumentError::Unknown { nearest, .. }) if nearest.contains("`evsm2`")
        ));
        assert!(matches!(
            error("{\"vsm\"}"),
            Some(TechniqueArgumentError::Json { .. })
        ));
        let layers = r#"{"lvsm": {"layers": 9}}"#;
        assert!(matches!(
            error(layers),
            Some(TechniqueArgumentError::Settings(_))
        ));
        assert_eq!(error(r#"{"esm": {"exponent": 20.0}}"#), None);
    }
}
