//! Techniques: what can be asked of a map, and how it has to be encoded for that.

mod best;
mod convolution;
mod depth_tests;
mod encoding;
mod esm;
mod evsm;
mod exponents;
mod far;
mod finite;
mod lvsm;
mod modules;
mod moments;
mod name;
mod row;
mod settings;
mod vsm;

use core::fmt;

pub use encoding::MapEncoding;
pub use finite::Finite;
pub use row::{Blended, Row};
use serde::{Deserialize, Serialize};
pub use settings::{EsmFiltering, LayerSplits, PcfTaps};

use crate::{Profile, Storage, ValueError};

/// A way to turn a light's map into shadow intensity.
///
/// The first three read the plain depth map, at a cost that grows with the filter. The others read a *filterable* map, which
/// is blurred once and looked up once.
///
/// In files a technique is a name alone, for usual settings, or a name with settings: `"evsm4"`, `{"evsm4": {"positive": 20}}`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase", deny_unknown_fields, remote = "Self")]
#[cfg_attr(feature = "schema", schemars(transform = name::schema))]
pub enum Technique {
    /// The comparison with the nearest texel (Williams, SIGGRAPH 1978).
    Binary,
    /// Percentage-closer filtering: the mean of comparisons (Reeves, Salesin & Cook, SIGGRAPH 1987).
    Pcf(PcfTaps),
    /// Percentage-closer soft shadows: a filter as wide as the penumbra (Fernando, SIGGRAPH 2005).
    /// The light's size is a parameter of each view.
    Pcss {
        /// Taps of the blocker search, 1 to 4096.
        search_taps: u32,
        /// Taps of the filter, 1 to 4096.
        filter_taps: u32,
    },
    /// Exponential shadow maps (Annen et al., GI 2008; Salvi 2008).
    Esm {
        /// The exponent c over moment depth, at least 1: shadows fade in over a depth of 1 / c. Where it is left out, 80, or the
        /// largest that the storage takes.
        #[serde(skip_serializing_if = "Option::is_none")]
        exponent: Option<Finite>,
        /// What is filtered.
        #[serde(default)]
        filtering: EsmFiltering,
    },
    /// Variance shadow maps (Donnelly & Lauritzen, i3D 2006).
    Vsm,
    /// Exponential variance shadow maps with the positive warp (Lauritzen & McCool, GI 2008).
    Evsm2 {
        /// The exponent of e^(c z). Where it is left out, 40, or the largest that the storage takes.
        #[serde(skip_serializing_if = "Option::is_none")]
        exponent: Option<Finite>,
    },
    /// Exponential variance shadow maps with both warps (Lauritzen & McCool, GI 2008).
    Evsm4 {
        /// The exponent of e^(c z). Where it is left out, 40, or the largest that the storage takes.
        #[serde(skip_serializing_if = "Option::is_none")]
        positive: Option<Finite>,
        /// The exponent of -e^(-c z). Where it is left out, 5.
        #[serde(skip_serializing_if = "Option::is_none")]
        negative: Option<Finite>,
    },
    /// Layered variance shadow maps (Lauritzen & McCool, GI 2008).
    Lvsm {
        /// Layers, 1 to 8.
        layers: u32,
        /// Both layers at a split reach this far beyond it, in moment depth.
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
    /// Every technique with usual settings, percentage-closer filtering and exponential maps with each kind of them. The first
    /// of each name is what the name alone stands for.
    #[must_use]
    pub fn examples() -> Vec<Technique> {
        let pcf = [
            PcfTaps::Gaussian {
                radius: 4,
                sigma: Finite(2.4),
            },
            PcfTaps::Box { radius: 2 },
            PcfTaps::Weights([1.0, 2.0, 3.0, 2.0, 1.0].map(Finite).to_vec()),
            PcfTaps::Poisson {
                radius: Finite(4.0),
            },
            PcfTaps::Hardware {
                radius: 2,
                reversed: false,
            },
        ];
        let pcss = Technique::Pcss {
            search_taps: 16,
            filter_taps: 32,
        };
        let esm = |filtering| Technique::Esm {
            exponent: None,
            filtering,
        };
        let tests = [Technique::Binary].into_iter();
        let tests = tests.chain(pcf.map(Technique::Pcf)).chain([pcss]);
        let filterable = [
            esm(EsmFiltering::Linear),
            esm(EsmFiltering::Logarithmic),
            Technique::Vsm,
            Technique::Evsm2 { exponent: None },
            Technique::Evsm4 {
                positive: None,
                negative: None,
            },
            Technique::Lvsm {
                layers: 4,
                overlap: Finite(0.02),
                splits: LayerSplits::Uniform,
            },
            Technique::Convolution {
                terms: 8,
                lower_bound: true,
            },
            Technique::Hamburger4,
            Technique::Hausdorff4,
            Technique::Hamburger6,
        ];
        tests.chain(filterable).collect()
    }

    /// What the library knows about the technique with these settings. Everything else about techniques is read from here.
    #[must_use]
    pub fn row(&self) -> Row {
        match self {
            Technique::Binary => depth_tests::binary(),
            Technique::Pcf(taps) => depth_tests::pcf(taps),
            Technique::Pcss {
                search_taps,
                filter_taps,
            } => depth_tests::pcss(*search_taps, *filter_taps),
            Technique::Esm {
                exponent,
                filtering,
            } => esm::row(*exponent, *filtering),
            Technique::Vsm => vsm::row(),
            Technique::Evsm2 { exponent } => evsm::evsm2(*exponent),
            Technique::Evsm4 { positive, negative } => evsm::evsm4(*positive, *negative),
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
    pub fn check(&self) -> Result<(), ValueError> {
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

    /// The first of the row's [`storages`](Row::storages) that every device of the profile can write; `None` if the technique reads depth.
    #[must_use]
    pub fn best_storage(&self, profile: Profile) -> Option<Storage> {
        let row = self.row();
        row.storages.iter().copied().find(|&storage| {
            let format = storage.format_of(row.channels);
            format.is_some_and(|format| storage.can_write(format, profile))
        })
    }
}

/// Refuses a setting that is not `valid`.
fn setting(
    valid: bool,
    technique: &str,
    name: &'static str,
    value: impl fmt::Display,
    legal: &str,
) -> Result<(), ValueError> {
    if valid {
        return Ok(());
    }
    let message = format!("'{technique}' has {value} as its {name}; it is {legal}");
    Err(ValueError::new(name, message))
}

/// Checks a number of things: at least one, at most `largest`.
fn count(technique: &str, name: &'static str, count: u32, largest: u32) -> Result<(), ValueError> {
    if (1..=largest).contains(&count) {
        return Ok(());
    }
    let message = format!("'{technique}' has {count} {name}; it can have 1 to {largest}");
    Err(ValueError::new(name, message))
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
