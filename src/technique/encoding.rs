//! How a filterable map is encoded: a technique and a storage that go together.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::{EsmFiltering, Finite, LayerSplits, PcfTaps, Technique, TechniqueError};
use crate::{Profile, Storage, SummedAreaTable, TextureFormat, UnsupportedStorage};

/// The encoding of a filterable map: a technique with a storage that it can use.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "Pair", into = "Pair")]
pub struct MapEncoding {
    technique: Technique,
    storage: Storage,
    format: TextureFormat,
    table: Option<SummedAreaTable>,
}

/// As it is written in files.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Pair {
    #[serde(default)]
    technique: Technique,
    storage: Storage,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    table: Option<SummedAreaTable>,
}

/// The most layers of a layered variance shadow map (`LAYERED_VARIANCE_LARGEST_COUNT` in WGSL).
const MOST_LAYERS: u32 = 8;

/// The most terms of a convolution shadow map (`CONVOLUTION_LARGEST_TERMS` in WGSL).
const MOST_TERMS: u32 = 16;

/// The largest radius of percentage-closer filters in texels (`PERCENTAGE_CLOSER_LARGEST_RADIUS` in WGSL).
const LARGEST_RADIUS: u32 = 64;

/// The largest radius of a disk in texels (`PERCENTAGE_CLOSER_LARGEST_DISK` in WGSL).
const LARGEST_DISK: f32 = 4096.0;

/// The most taps of percentage-closer soft shadows (`PERCENTAGE_CLOSER_SOFT_MOST_TAPS` in WGSL).
const MOST_TAPS: u32 = 4096;

impl MapEncoding {
    /// The encoding, if the storage is one of the technique's and its settings are within their ranges.
    pub fn new(technique: Technique, storage: Storage) -> Result<Self, TechniqueError> {
        technique.check()?;
        if technique.reads_depth() {
            return Err(TechniqueError::ReadsDepth {
                technique: technique.name(),
            });
        }
        let format = storage
            .format_of(technique.channels())
            .filter(|_| technique.storages().contains(&storage))
            .ok_or(TechniqueError::Storage {
                technique: technique.name(),
                storage,
                legal: technique.storages(),
            })?;
        technique.check_exponents(storage)?;
        Ok(Self {
            technique,
            storage,
            format,
            table: None,
        })
    }

    /// The summed-area table of a map with this technique: of four moments or two.
    pub fn of_table(technique: Technique, table: SummedAreaTable) -> Result<Self, TechniqueError> {
        let moments = matches!(
            technique,
            Technique::Hamburger4 | Technique::Hausdorff4 | Technique::Vsm
        );
        let format = Storage::Fixed32
            .format_of(technique.channels())
            .filter(|_| moments)
            .ok_or(TechniqueError::NoTable {
                technique: technique.name(),
            })?;
        Ok(Self {
            technique,
            storage: Storage::Fixed32,
            format,
            table: Some(table),
        })
    }

    /// Four moments, which both `hamburger4` and `hausdorff4` read.
    #[must_use]
    pub fn of_four_moments(format: TextureFormat) -> Option<Self> {
        Storage::of_format(format).map(|storage| Self {
            technique: Technique::Hamburger4,
            storage,
            format,
            table: None,
        })
    }

    /// The technique that the map was made for.
    #[must_use]
    pub fn technique(&self) -> &Technique {
        &self.technique
    }

    /// The storage.
    #[must_use]
    pub fn storage(&self) -> Storage {
        self.storage
    }

    /// What the integers mean, if this is a summed-area table.
    #[must_use]
    pub fn table(&self) -> Option<&SummedAreaTable> {
        self.table.as_ref()
    }

    /// The format of the texture.
    #[must_use]
    pub fn format(&self) -> TextureFormat {
        self.format
    }

    /// Whether blurs sum its texels with the WGSL module `split_sum`: moments within [-1, 1] whose
    /// storage is as fine as sums of f32 are.
    #[must_use]
    pub fn has_split_sums(&self) -> bool {
        let moments = matches!(
            self.technique,
            Technique::Vsm
                | Technique::Lvsm { .. }
                | Technique::Hamburger4
                | Technique::Hausdorff4
                | Technique::Hamburger6
        );
        moments && self.storage == Storage::Float32
    }

    /// Texture layers that a layer of the map consists of.
    #[must_use]
    pub fn planes(&self) -> u32 {
        self.technique.planes()
    }

    /// Bits of a texel of the map, all planes.
    #[must_use]
    pub fn bits_per_texel(&self) -> u32 {
        self.format.bytes_per_texel() * 8 * self.planes()
    }

    /// Whether every device of the profile can write the map, or which storage to use instead.
    pub fn check(&self, profile: Profile) -> Result<(), UnsupportedStorage> {
        if self.storage.can_write(self.format, profile) {
            return Ok(());
        }
        Err(UnsupportedStorage {
            storage: self.storage,
            format: self.format,
            profile,
            alternative: self
                .technique
                .best_storage(profile)
                .unwrap_or_else(|| Storage::best_for(profile)),
        })
    }
}

impl Technique {
    /// Whether the settings are within their ranges, whatever the storage.
    pub fn check(&self) -> Result<(), TechniqueError> {
        match self {
            Technique::Lvsm {
                layers,
                overlap,
                splits,
            } => {
                self.check_count("layers", *layers, MOST_LAYERS)?;
                if !(0.0..=0.5).contains(&overlap.get()) {
                    return Err(self.setting("overlap", *overlap, "from 0 to 0.5"));
                }
                check_splits(*layers, *overlap, splits)
            }
            Technique::Convolution { terms, .. } => self.check_count("terms", *terms, MOST_TERMS),
            Technique::Pcf(taps) => self.check_taps(taps),
            Technique::Pcss(taps) => {
                self.check_count("search taps", taps.search_taps, MOST_TAPS)?;
                self.check_count("filter taps", taps.filter_taps, MOST_TAPS)
            }
            _ => Ok(()),
        }
    }

    fn check_taps(&self, taps: &PcfTaps) -> Result<(), TechniqueError> {
        let radius = |radius: u32| {
            let radius = u16::try_from(radius).unwrap_or(u16::MAX);
            if u32::from(radius) > LARGEST_RADIUS {
                return Err(self.setting("radius", radius.into(), "from 0 to 64 texels"));
            }
            Ok(())
        };
        match taps {
            PcfTaps::Box { radius: r } | PcfTaps::Hardware { radius: r, .. } => radius(*r),
            PcfTaps::Gaussian { radius: r, sigma } => {
                radius(*r)?;
                if sigma.get() <= 0.0 {
                    return Err(self.setting("standard deviation", *sigma, "positive"));
                }
                Ok(())
            }
            PcfTaps::Weights(weights) => {
                let odd =
                    weights.len() % 2 == 1 && weights.len() <= 2 * LARGEST_RADIUS as usize + 1;
                let negative = weights.iter().any(|weight| *weight < Finite::ZERO);
                let sum: f32 = weights.iter().map(|weight| weight.get()).sum();
                if odd && !negative && sum > 0.0 && sum.is_finite() {
                    return Ok(());
                }
                Err(TechniqueError::Weights {
                    count: weights.len(),
                })
            }
            PcfTaps::Poisson { radius } => {
                if (0.0..=LARGEST_DISK).contains(&radius.get()) {
                    return Ok(());
                }
                Err(self.setting("radius", *radius, "from 0 to 4096 texels"))
            }
        }
    }

    fn check_count(
        &self,
        what: &'static str,
        count: u32,
        largest: u32,
    ) -> Result<(), TechniqueError> {
        if (1..=largest).contains(&count) {
            return Ok(());
        }
        Err(TechniqueError::Count {
            technique: self.name(),
            what,
            count,
            smallest: 1,
            largest,
        })
    }

    fn setting(&self, what: &'static str, value: Finite, range: &'static str) -> TechniqueError {
        TechniqueError::Setting {
            technique: self.name(),
            what,
            value,
            range,
        }
    }

    /// The largest exponent that a storage's range and precision allow; none for techniques without one. The WGSL modules
    /// `exponential` and `exponential_variance` derive these.
    #[must_use]
    pub fn largest_exponent(&self, storage: Storage) -> Option<f32> {
        match self {
            Technique::Esm { filtering, .. } => Some(match (storage, filtering) {
                (Storage::Float16, EsmFiltering::Linear) => 9.7,
                (Storage::Float16, EsmFiltering::Logarithmic) => 13.6,
                (Storage::Unorm16 | Storage::Unorm8, EsmFiltering::Linear) => 3.0,
                _ => 87.0,
            }),
            Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => Some(match storage {
                Storage::Float16 => 5.54,
                _ => 43.6,
            }),
            _ => None,
        }
    }

    fn check_exponents(&self, storage: Storage) -> Result<(), TechniqueError> {
        let exponents = match self {
            Technique::Esm { exponent, .. } | Technique::Evsm2 { exponent } => vec![*exponent],
            Technique::Evsm4 { positive, negative } => vec![*positive, *negative],
            _ => return Ok(()),
        };
        let largest = self.largest_exponent(storage).unwrap_or(f32::MAX);
        match exponents
            .iter()
            .find(|exponent| !(1.0..=largest).contains(&exponent.get()))
        {
            None => Ok(()),
            Some(exponent) => Err(TechniqueError::Exponent {
                technique: self.name(),
                storage,
                exponent: *exponent,
                largest,
            }),
        }
    }
}

fn check_splits(layers: u32, overlap: Finite, splits: &LayerSplits) -> Result<(), TechniqueError> {
    let LayerSplits::Given(given) = splits else {
        return Ok(());
    };
    let places: Vec<f32> = core::iter::once(-1.0)
        .chain(given.iter().map(|split| split.get()))
        .chain([1.0])
        .collect();
    // Layers that are narrower than their overlap would contain others.
    let apart = |pair: &[f32]| pair[1] - pair[0] > overlap.get();
    if given.len() + 1 == layers as usize && places.windows(2).all(apart) {
        return Ok(());
    }
    Err(TechniqueError::Splits {
        layers,
        given: given.len(),
    })
}

impl TryFrom<Pair> for MapEncoding {
    type Error = TechniqueError;

    fn try_from(pair: Pair) -> Result<Self, TechniqueError> {
        match (pair.storage, pair.table) {
            (Storage::Fixed32, Some(table)) => Self::of_table(pair.technique, table),
            (_, None) => Self::new(pair.technique, pair.storage),
            (storage, Some(_)) => Err(TechniqueError::NotATable { storage }),
        }
    }
}

impl From<MapEncoding> for Pair {
    fn from(encoding: MapEncoding) -> Pair {
        Pair {
            technique: encoding.technique,
            storage: encoding.storage,
            table: encoding.table,
        }
    }
}

impl fmt::Display for MapEncoding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.table {
            Some(table) => write!(f, "{} as {table}", self.technique),
            None => write!(f, "{} as {}", self.technique, self.storage),
        }
    }
}
