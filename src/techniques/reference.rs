//! Settings of the tests on the plain depth map.

use serde::{Deserialize, Serialize};

use super::Finite;

/// The comparisons that percentage-closer filtering averages. Radii are in texels.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
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
