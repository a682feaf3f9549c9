//! What a file leaves to the library.

use core::fmt;

use moment_shadows::{MapEncoding, Profile, Storage, Technique, ValueError};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, IntoDeserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::Resolve;

impl Resolve {
    /// What the library takes on a device of the profile, for a map with the mip levels that it has, which is filtered afterwards or written
    /// once.
    pub(super) fn best(&self, profile: Profile, once: bool) -> Result<MapEncoding, ValueError> {
        let bits = self.bits.unwrap_or(64);
        let suits = |it: &MapEncoding| {
            let is_asked_for = self.storage.is_empty() || self.storage.contains(&it.storage());
            // Packed texels have no mip levels.
            let is_written = once || !it.storage().is_written_once();
            is_asked_for && is_written && (self.mip_levels == Some(1) || it.averaged_by_samplers())
        };
        let found = Technique::by_error(profile, bits).find(suits);
        found.ok_or_else(|| {
            let storages: Vec<String> = self.storage.iter().map(|it| format!("'{it}'")).collect();
            let stored = match storages.as_slice() {
                [] => String::new(),
                some => format!(", stored as {},", some.join(" or ")),
            };
            let message = format!(
                "{bits}; no technique has a map of so few per texel{stored} under {profile}"
            );
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
