//! Techniques: what can be asked of a map, and how it has to be encoded for that.

mod convolution;
mod depth_tests;
mod encoding;
mod error;
mod esm;
mod evsm;
mod finite;
mod lvsm;
mod modules;
mod moments;
mod reference;
mod row;
mod settings;
mod vsm;

use core::fmt;

pub use encoding::MapEncoding;
pub use error::TechniqueError;
pub use finite::{Finite, NotFinite};
pub use reference::{PcfTaps, Pcss};
pub use row::{Contents, Row};
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
/// | `hamburger6` | 4 | 2 | unorm16, float16, float32, unorm10 |
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
    /// Exponential variance shadow maps with both warps (Lauritzen & McCool, GI 2008).
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
    /// The sharp lower bound from four moments on the light's range (Peters & Klein, i3D 2015).
    Hausdorff4,
    /// The sharp lower bound from six moments on the real line (Peters et al., JCGT 6(1) 2017): reproduces three surfaces, where
    /// four moments reproduce two.
    Hamburger6,
}

fn yes() -> bool {
    true
}

impl Technique {
    /// What the library knows about the technique with these settings. Everything else about techniques is read from here.
    #[must_use]
    pub fn row(&self) -> Row {
        match self {
            Technique::Binary => depth_tests::binary(),
            Technique::Pcf(taps) => depth_tests::pcf(taps),
            Technique::Pcss(taps) => depth_tests::pcss(taps),
            Technique::Esm {
                exponent,
                filtering,
            } => esm::row(*exponent, *filtering),
            Technique::Vsm => vsm::row(),
            Technique::Evsm2 { exponent } => evsm::row_of_one(*exponent),
            Technique::Evsm4 { positive, negative } => evsm::row_of_both(*positive, *negative),
            Technique::Lvsm {
                layers,
                overlap,
                splits,
            } => lvsm::row(*layers, *overlap, splits),
            Technique::Convolution { terms, lower_bound } => convolution::row(*terms, *lower_bound),
            Technique::Hamburger4 => moments::hamburger4(),
            Technique::Hausdorff4 => moments::hausdorff4(),
            Technique::Hamburger6 => moments::hamburger6(),
        }
    }

    /// Checks that the settings are within their ranges, whatever the storage.
    pub fn check(&self) -> Result<(), TechniqueError> {
        self.row().settings
    }

    /// The name in graph files and on command lines.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.row().name
    }

    /// Whether the technique reads the plain depth map instead of a filterable one.
    #[must_use]
    pub fn reads_depth(&self) -> bool {
        self.row().reads_depth()
    }

    /// The storages of the technique's map, the one with the least error per bit first. Empty if the technique reads depth.
    #[must_use]
    pub fn storages(&self) -> &'static [Storage] {
        self.row().storages
    }

    /// The first of [`Technique::storages`] that every device of the profile can write; `None` if the technique reads depth.
    #[must_use]
    pub fn best_storage(&self, profile: Profile) -> Option<Storage> {
        let row = self.row();
        row.storages.iter().copied().find(|&storage| {
            let format = storage.format_of(row.channels);
            format.is_some_and(|format| storage.can_write(format, profile))
        })
    }

    /// Texture layers that a layer of the map consists of.
    #[must_use]
    pub fn planes(&self) -> u32 {
        self.row().planes
    }

    /// Whether both techniques read the same map.
    #[must_use]
    pub fn shares_map_with(&self, other: &Technique) -> bool {
        self.row().shares_map_with(&other.row())
    }

    /// The largest exponent that a storage's range and precision allow; `None` for techniques without one.
    #[must_use]
    pub fn largest_exponent(&self, storage: Storage) -> Option<f32> {
        self.row().largest_exponent.map(|largest| largest(storage))
    }
}

/// Checks a number of things: at least one, at most `largest`.
fn count(
    technique: &'static str,
    what: &'static str,
    count: u32,
    largest: u32,
) -> Result<(), TechniqueError> {
    if (1..=largest).contains(&count) {
        return Ok(());
    }
    Err(TechniqueError::Count {
        technique,
        what,
        count,
        smallest: 1,
        largest,
    })
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
