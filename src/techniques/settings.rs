//! Settings of techniques.

use serde::{Deserialize, Serialize};

use super::Finite;

/// What the filter of an exponential shadow map averages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// The comparisons that percentage-closer filtering averages. Radii are in texels.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum PcfTaps {
    /// A square of 2 radius + 1 texels per side with equal weights, and bilinear in between.
    Box {
        /// 0 to 64.
        radius: u32,
    },
    /// A square of 2 radius + 1 texels per side with Gaussian weights, and bilinear in between.
    Gaussian {
        /// 0 to 64.
        radius: u32,
        /// Standard deviation in texels, positive.
        sigma: Finite,
    },
    /// A square with any weights, bilinear in between: those of a row or column from end to end, an odd number of them, up to
    /// 129, none negative.
    Weights(Vec<Finite>),
    /// 16 places in a disk, rotated from pixel to pixel.
    Poisson {
        /// The radius of the disk, from 0 to 4096.
        radius: Finite,
    },
    /// A square of bilinear comparisons by a comparison sampler.
    Hardware {
        /// 0 to 64.
        radius: u32,
        /// Whether the map stores 1 at the near plane.
        #[serde(default)]
        reversed: bool,
    },
}
