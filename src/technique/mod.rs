//! What can be asked of a map, and how it has to be encoded for that.

mod encoding;
mod error;
mod finite;
mod reference;
mod settings;

use core::fmt;

pub use encoding::MapEncoding;
pub use error::TechniqueError;
pub use finite::{Finite, NotFinite};
pub use reference::{PcfTaps, Pcss};
use serde::{Deserialize, Serialize};
pub use settings::{EsmFiltering, LayerSplits};

use crate::{Profile, Storage};

/// A way to turn a light's map into shadow intensity.
///
/// The first three read the plain depth map, at a cost that grows with the filter. The others read a *filterable* map, which
/// is blurred once and looked up once.
///
/// | technique | channels per plane | planes | storages |
/// |---|---|---|---|
/// | `binary`, `pcf`, `pcss` | (the depth map) | | |
/// | `esm` | 1 | 1 | unorm16, float16, float32 |
/// | `vsm` | 2 | 1 | unorm16, float16, float32 |
/// | `evsm2` | 2 | 1 | float16, float32 |
/// | `evsm4` | 4 | 1 | float16, float32 |
/// | `lvsm` | 4 | one for two layers | unorm16, float16, float32 |
/// | `convolution` | 4 | one for two terms | unorm8, unorm16, float16 |
/// | `hamburger4`, `hausdorff4` | 4 | 1 | unorm16, float16, float32 |
/// | `hamburger6` | 4 | 2 | unorm16, float16, float32 |
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Technique {
    /// The comparison with the nearest texel (Williams, SIGGRAPH 1978).
    Binary,
    /// Percentage-closer filtering: the mean of comparisons (Reeves, Salesin & Cook, SIGGRAPH 1987).
    Pcf(PcfTaps),
    /// Percentage-closer soft shadows: a filter as wide as the penumbra (Fernando, SIGGRAPH 2005).
    Pcss(Pcss),
    /// Exponential shadow maps (Annen et al., GI 2008; Salvi 2008).
    Esm {
        /// The exponent c over moment depth, at least 1: shadows fade in over a depth of 1 / c.
        exponent: Finite,
        /// What is filtered.
        #[serde(default)]
        filtering: EsmFiltering,
    },
    /// Variance shadow maps (Donnelly & Lauritzen, i3D 2006).
    Vsm,
    /// Exponential variance shadow maps with the positive warp (Lauritzen & McCool, GI 2008).
    Evsm2 {
        /// The exponent of e^(c z).
        exponent: Finite,
    },
    /// The same with both warps.
    Evsm4 {
        /// The exponent of e^(c z).
        positive: Finite,
        /// The exponent of -e^(-c z).
        negative: Finite,
    },
    /// Layered variance shadow maps (Lauritzen & McCool, GI 2008).
    Lvsm {
        /// Layers, 1 to 8.
        layers: u32,
        /// Both layers at a split reach this far beyond it, in moment depth, and blend there.
        #[serde(default)]
        overlap: Finite,
        /// Where one layer ends and the next begins.
        #[serde(default)]
        splits: LayerSplits,
    },
    /// Convolution shadow maps (Annen et al., EGSR 2007).
    Convolution {
        /// Terms of the Fourier series, 1 to 16.
        terms: u32,
        /// Whether the result is a lower bound of shadow intensity; otherwise it is the damped series itself, which may be
        /// darker than the truth.
        #[serde(default = "yes")]
        lower_bound: bool,
    },
    /// The sharp lower bound from four moments on the real line (Peters & Klein, i3D 2015).
    #[default]
    Hamburger4,
    /// The sharp lower bound from four moments on the light's range (the same).
    Hausdorff4,
    /// The sharp lower bound from six moments on the real line (Peters et al., JCGT 6(1) 2017): reproduces three surfaces, where
    /// four moments reproduce two.
    Hamburger6,
}

fn yes() -> bool {
    true
}

impl Technique {
    /// The name in graph files and on command lines.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Technique::Binary => "binary",
            Technique::Pcf(_) => "pcf",
            Technique::Pcss(_) => "pcss",
            Technique::Esm { .. } => "esm",
            Technique::Vsm => "vsm",
            Technique::Evsm2 { .. } => "evsm2",
            Technique::Evsm4 { .. } => "evsm4",
            Technique::Lvsm { .. } => "lvsm",
            Technique::Convolution { .. } => "convolution",
            Technique::Hamburger4 => "hamburger4",
            Technique::Hausdorff4 => "hausdorff4",
            Technique::Hamburger6 => "hamburger6",
        }
    }

    /// Whether the technique reads the plain depth map instead of a filterable one.
    #[must_use]
    pub fn reads_depth(&self) -> bool {
        matches!(
            self,
            Technique::Binary | Technique::Pcf(_) | Technique::Pcss(_)
        )
    }

    /// The storages of the technique's map, the one with the least error per bit first. None where it reads depth.
    #[must_use]
    pub fn storages(&self) -> &'static [Storage] {
        use Storage::{Float16, Float32, Unorm8, Unorm10, Unorm16};
        match self {
            Technique::Binary | Technique::Pcf(_) | Technique::Pcss(_) => &[],
            Technique::Esm {
                filtering: EsmFiltering::Linear,
                ..
            } => &[Float32, Float16, Unorm16],
            Technique::Esm { .. } | Technique::Vsm | Technique::Lvsm { .. } => {
                &[Unorm16, Float32, Float16]
            }
            Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => &[Float32, Float16],
            Technique::Convolution { .. } => &[Unorm8, Unorm16, Float16],
            Technique::Hamburger4 | Technique::Hausdorff4 => &[Unorm16, Float16, Float32],
            // Half as large as the others, but the one that leaks farthest.
            Technique::Hamburger6 => &[Unorm16, Float16, Float32, Unorm10],
        }
    }

    /// The first of [`Technique::storages`] that every device of the profile can write; none where the technique reads
    /// depth.
    #[must_use]
    pub fn best_storage(&self, profile: Profile) -> Option<Storage> {
        self.storages().iter().copied().find(|&storage| {
            let format = storage.format_of(self.channels());
            format.is_some_and(|format| storage.can_write(format, profile))
        })
    }

    /// Channels of a plane of the map: 1, 2 or 4.
    #[must_use]
    pub fn channels(&self) -> u32 {
        match self {
            Technique::Esm { .. } | Technique::Binary | Technique::Pcf(_) | Technique::Pcss(_) => 1,
            Technique::Vsm | Technique::Evsm2 { .. } => 2,
            _ => 4,
        }
    }

    /// Texture layers that a layer of the map consists of.
    #[must_use]
    pub fn planes(&self) -> u32 {
        match self {
            Technique::Lvsm { layers, .. } => layers.div_ceil(2),
            Technique::Convolution { terms, .. } => terms.div_ceil(2),
            Technique::Hamburger6 => 2,
            _ => 1,
        }
    }

    /// Whether both techniques read the same map.
    #[must_use]
    pub fn shares_map_with(&self, other: &Technique) -> bool {
        match (self, other) {
            (
                Technique::Hamburger4 | Technique::Hausdorff4,
                Technique::Hamburger4 | Technique::Hausdorff4,
            ) => true,
            (
                Technique::Convolution { terms, .. },
                Technique::Convolution { terms: others, .. },
            ) => terms == others,
            _ => self == other,
        }
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
