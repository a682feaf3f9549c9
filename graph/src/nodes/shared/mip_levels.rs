//! Room for mip levels as a node's property.

use serde::{Deserialize, Deserializer};

use super::wrong_size;
use crate::{GraphError, TextureDesc};

/// One level, where a file does not say how many.
pub(in crate::nodes) fn one() -> Option<u32> {
    Some(1)
}

/// A number, or `"all"`, which is `None`.
pub(in crate::nodes) fn read<'de, D: Deserializer<'de>>(file: D) -> Result<Option<u32>, D::Error> {
    #[derive(Deserialize)]
    #[serde(rename_all = "snake_case")]
    enum MipLevels {
        All,
        #[serde(untagged)]
        Count(u32),
    }
    Ok(match MipLevels::deserialize(file)? {
        MipLevels::All => None,
        MipLevels::Count(count) => Some(count),
    })
}

#[cfg(feature = "schema")]
pub(in crate::nodes) fn schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    schemars::json_schema!({
        "anyOf": [{ "const": "all" }, { "type": "integer", "minimum": 1 }],
        "default": 1,
    })
}

/// The number for a map of a size. A region has texels on every level only if it is large enough for it, so more levels than
/// the shorter side of the whole map allows are refused.
pub(in crate::nodes) fn count(levels: Option<u32>, [x, y]: [u32; 2]) -> Result<u32, GraphError> {
    let most = TextureDesc::most_levels([x, y]);
    let count = levels.unwrap_or(most);
    if (1..=most).contains(&count) {
        return Ok(count);
    }
    Err(wrong_size(format!(
        "'mip_levels' is {count}; a map of {x}x{y} texels has from 1 to {most}, or \"all\""
    )))
}
