//! Techniques in files: by name alone, or with settings.

use core::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{self, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::Technique;
use crate::nearest;

impl Serialize for Technique {
    fn serialize<S: Serializer>(&self, file: S) -> Result<S::Ok, S::Error> {
        // The derived function of this name.
        Technique::serialize(self, file)
    }
}

impl<'de> Deserialize<'de> for Technique {
    fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
        file.deserialize_any(Written)
    }
}

struct Written;

impl<'de> Visitor<'de> for Written {
    type Value = Technique;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a technique, or an object of a name and its settings")
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Technique, E> {
        let mut all = Technique::examples();
        match all.iter().position(|usual| usual.name() == name) {
            Some(index) => Ok(all.swap_remove(index)),
            None => {
                let mut names: Vec<_> = all.iter().map(Technique::name).collect();
                names.dedup();
                let nearest = nearest(name, names);
                Err(E::custom(format_args!(
                    "there is no technique '{name}'; the nearest are {nearest}"
                )))
            }
        }
    }

    fn visit_map<A: MapAccess<'de>>(self, settings: A) -> Result<Technique, A::Error> {
        // The derived function of this name.
        Technique::deserialize(MapAccessDeserializer::new(settings))
    }
}

/// Adds names alone to the schema of names with settings.
#[cfg(feature = "schema")]
pub(super) fn schema(derived: &mut schemars::Schema) {
    let mut names: Vec<_> = Technique::examples().iter().map(Technique::name).collect();
    names.dedup();
    let alone = schemars::json_schema!({
        "description": "A technique with usual settings.",
        "enum": names,
    });
    *derived = schemars::json_schema!({
        "description": derived.remove("description"),
        "anyOf": [alone, derived],
    });
}
