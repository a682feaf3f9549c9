//! What a file leaves to the library: how many steps a ray has, and at which part of the resolution.

use core::fmt;

use moment_shadows::{Resolution, ScatteringWay};
use serde::de::{self, Visitor};
use serde::{Deserializer, de::Unexpected};

use super::super::shared::wrong_property;
use super::MarchScattering;
use crate::GraphError;

/// The most steps of a ray: what truths take.
const MOST_STEPS: u32 = 1024;

impl MarchScattering {
    /// Steps of a ray, and the part of the resolution: those that are given, or for `"best"` those with the least error as recorded.
    ///
    /// # Errors
    /// [`GraphError`], if properties do not go together, or no way has so few lookups.
    pub fn chosen(&self) -> Result<(u32, Resolution), GraphError> {
        let Some(steps) = self.steps else {
            return self.best();
        };
        if self.lookups.is_some() || self.light.is_some() {
            return Err(wrong_property(format!(
                "'lookups' or 'light' beside {steps} 'steps'; they go with \"best\""
            )));
        }
        if !(1..=MOST_STEPS).contains(&steps) {
            return Err(wrong_property(format!(
                "'steps' is {steps}; a ray has 1 to {MOST_STEPS}"
            )));
        }
        Ok((steps, self.resolution.unwrap_or_default()))
    }

    fn best(&self) -> Result<(u32, Resolution), GraphError> {
        let (Some(light), Some(lookups)) = (self.light, self.lookups) else {
            return Err(wrong_property(
                "'steps' is \"best\": say which 'light' it is for, \"sun\", \"spot\" or \"point\", and how many 'lookups' of its map a pixel \
                 has at most",
            ));
        };
        if let Some(resolution) = self.resolution {
            return Err(wrong_property(format!(
                "'resolution' is {resolution:?} beside the 'steps' \"best\", which choose it: leave it out"
            )));
        }
        let lookups = f64::from(lookups);
        let mut all = ScatteringWay::by_error(light, false);
        let found = all.find_map(|(way, of_way, _)| match way {
            ScatteringWay::Marched { steps, resolution } if of_way <= lookups => {
                Some((steps, resolution))
            }
            ScatteringWay::Prefiltered | ScatteringWay::Marched { .. } => None,
        });
        found.ok_or_else(|| {
            let all = ScatteringWay::by_error(light, false).map(|(_, of_way, _)| of_way);
            let fewest = all.fold(f64::INFINITY, f64::min);
            wrong_property(format!(
                "'lookups' is {lookups}; no way that was measured has fewer than {fewest} per pixel"
            ))
        })
    }
}

/// The steps, where a file names none.
#[expect(clippy::unnecessary_wraps, reason = "it is the default of a field")]
pub(super) fn usual() -> Option<u32> {
    Some(16)
}

pub(super) fn steps<'de, D: Deserializer<'de>>(file: D) -> Result<Option<u32>, D::Error> {
    file.deserialize_any(StepsOrBest)
}

#[cfg(feature = "schema")]
pub(super) fn steps_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({ "anyOf": [{ "const": "best" }, { "type": "integer", "minimum": 1, "maximum": MOST_STEPS }] })
}

/// A number of steps, or `"best"`.
struct StepsOrBest;

impl Visitor<'_> for StepsOrBest {
    type Value = Option<u32>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number of steps or \"best\"")
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<Self::Value, E> {
        match text {
            "best" => Ok(None),
            _ => Err(E::invalid_value(Unexpected::Str(text), &self)),
        }
    }

    fn visit_u64<E: de::Error>(self, steps: u64) -> Result<Self::Value, E> {
        let steps = u32::try_from(steps);
        steps
            .map(Some)
            .map_err(|_| E::custom("a ray has 1 to 1024 steps"))
    }
}
