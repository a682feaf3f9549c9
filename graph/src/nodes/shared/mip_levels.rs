//! Room for mip levels as a node's property.

use serde::{Deserialize, Serialize};

use crate::{GraphError, GraphErrorKind, TextureDesc};

/// How many mip levels a map has room for; `downsample` fills all but the first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MipLevels {
    /// `"all"`: as many as the shorter side of the map allows.
    All,
    /// So many, the map itself included.
    #[serde(untagged)]
    Count(u32),
}

impl Default for MipLevels {
    /// The map itself.
    fn default() -> Self {
        Self::Count(1)
    }
}

impl MipLevels {
    /// The number for a map of a size. A region has texels on every level only if it is large enough for it, so more
    /// levels than the shorter side of the whole map allows are refused.
    pub(in crate::nodes) fn count(self, size: [u32; 2]) -> Result<u32, GraphError> {
        let most = TextureDesc::most_levels(size);
        match self {
            MipLevels::All => Ok(most),
            MipLevels::Count(count) if (1..=most).contains(&count) => Ok(count),
            MipLevels::Count(count) => Err(GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "'mip_levels' is {count}; a map of {}x{} texels has from 1 to {most}, or \"all\"",
                    size[0], size[1]
                ),
            )),
        }
    }
}
