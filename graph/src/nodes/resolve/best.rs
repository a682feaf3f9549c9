//! What a file leaves to the library.

use core::fmt;

use moment_shadows::{MapEncoding, Profile, Storage, Technique, ValueError};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::Resolve;

impl Resolve {
    /// What the library takes on a device of the profile.
    pub(super) fn best(&self, profile: Profile) -> Result<MapEncoding, ValueError> {
        if !self.storage.is_empty() {
            return Err(ValueError::new(
                "'storage'",
                "the technique \"best\" brings its own; leave it out, or name the technique",
            ));
        }
        let bits = self.bits.unwrap_or(64);
        Technique::best(profile, bits).ok_or_else(|| {
            let message =
                format!("{bits}; no technique has a map of so few per texel under {profile}");
            ValueError::new("'bits'", message)
        })
    }
}

/// The technique, where a file names none.
#[expect(clippy::unnecessary_wraps, reason = "it is the default of a field")]
pub(super) fn usual() -> Option<Technique> {
    Some(Technique::default())
}

pub(super) fn technique<'de, D: Deserializer<'de>>(file: D) -> Result<Option<Technique>, D::Error> {
    file.deserialize_any(TechniqueOrBest)
}

#[cfg(feature = "schema")]
pub(super) fn technique_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let technique = generator.subschema_for::<Technique>();
    schemars::json_schema!({ "anyOf": [{ "const": "best" }, technique] })
}

/// A technique, or `"best"`.
struct TechniqueOrBest;

impl<'de> Visitor<'de> for TechniqueOrBest {
    type Value = Option<Technique>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a technique, an object of a name and its settings, or \"best\"")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Option<Technique>, E> {
        if name == "best" {
            return Ok(None);
        }
        <Technique as Deserialize>::deserialize(name.into_deserializer()).map(Some)
    }

    fn visit_map<A: MapAccess<'de>>(self, settings: A) -> Result<Option<Technique>, A::Error> {
        <Technique as Deserialize>::deserialize(MapAccessDeserializer::new(settings)).map(Some)
    }
}

pub(super) fn storages<'de, D: Deserializer<'de>>(file: D) -> Result<Vec<Storage>, D::Error> {
    file.deserialize_any(Storages)
}

#[cfg(feature = "schema")]
pub(super) fn storages_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let storage = generator.subschema_for::<Storage>();
    schemars::json_schema!({
        "anyOf": [{ "const": "best" }, storage, { "type": "array", "items": storage }],
    })
}

/// A storage, several in the order of preference, or `"best"`.
struct Storages;

impl<'de> Visitor<'de> for Storages {
    type Value = Vec<Storage>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a storage, a list of storages or \"best\"")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Vec<Storage>, E> {
        if name == "best" {
            return Ok(Vec::new());
        }
        Ok(vec![Storage::deserialize(name.into_deserializer())?])
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Vec<Storage>, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list))
    }
}
