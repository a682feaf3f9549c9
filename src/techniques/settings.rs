//! Settings of the filterable techniques.

use serde::{Deserialize, Serialize};

use super::Finite;

/// What the filter of an exponential shadow map averages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EsmFiltering {
    /// The map holds the mean of e^(c z), which any filter averages.
    #[default]
    Linear,
    /// The map holds the logarithm of that mean, which takes fewer bits; every filter decodes texels before it averages them,
    /// so samplers and mip levels cannot be used.
    Logarithmic,
}

/// Where the layers of a layered variance shadow map lie.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum LayerSplits {
    /// Layers of equal depth.
    #[default]
    Uniform,
    /// The moment depths behind all layers but the last, ascending.
    Given(Vec<Finite>),
    /// Placed on the device by Lloyd relaxation, from the input `splits`.
    Lloyd,
}

impl LayerSplits {
    /// The splits behind all of `layers` layers but the last, where they are known beforehand.
    #[must_use]
    pub fn known(&self, layers: u32) -> Option<Vec<f32>> {
        match self {
            LayerSplits::Uniform => Some(
                (1..layers)
                    .map(|layer| 2.0 * layer as f32 / layers as f32 - 1.0)
                    .collect(),
            ),
            LayerSplits::Given(splits) => Some(splits.iter().map(|split| split.get()).collect()),
            LayerSplits::Lloyd => None,
        }
    }
}
