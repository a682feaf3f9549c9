//! How a filterable map is encoded: a technique and a storage that go together.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::{Row, Technique};
use crate::{Profile, Storage, SummedAreaTable, TextureFormat, ValueError};

/// The encoding of a filterable map: a technique with a storage that it can use.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "Pair")]
pub struct MapEncoding {
    technique: Technique,
    storage: Storage,
    #[serde(skip_serializing)]
    format: TextureFormat,
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<SummedAreaTable>,
}

/// The encoding's form in files.
#[derive(Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
struct Pair {
    #[serde(default)]
    technique: Technique,
    storage: Storage,
    table: Option<SummedAreaTable>,
}

impl MapEncoding {
    /// The encoding, if the storage is one of the technique's and its settings are within their ranges.
    pub fn new(technique: Technique, storage: Storage) -> Result<Self, ValueError> {
        let row = technique.row();
        row.settings.clone()?;
        if row.reads_depth() {
            let message = format!(
                "'{technique}' reads the plain depth map, which needs no storage; connect the map to 'depth' of the node that \
                 shades"
            );
            return Err(ValueError::new("technique", message));
        }
        let format = storage
            .format_of(row.channels)
            .filter(|_| row.storages.contains(&storage))
            .ok_or_else(|| {
                let legal = listed(row.storages.iter().map(|legal| legal.name()));
                let message =
                    format!("'{technique}' cannot be stored as {storage}; it can as {legal}");
                ValueError::new("storage", message)
            })?;
        check_exponents(&row, storage)?;
        Ok(Self {
            technique: technique.in_storage(storage),
            storage,
            format,
            table: None,
        })
    }

    /// The encoding of a summed-area table of a map with this technique, which stores four moments or two.
    pub fn of_table(technique: Technique, table: SummedAreaTable) -> Result<Self, ValueError> {
        let row = technique.row();
        let format = Storage::Fixed32
            .format_of(row.channels)
            .filter(|_| row.has_table)
            .ok_or_else(|| {
                let others = Technique::examples();
                let others = others.iter().filter(|other| other.row().has_table);
                let message = format!(
                    "no summed-area table is made of a map for '{technique}'; one is of maps for {}",
                    listed(others.map(Technique::name))
                );
                ValueError::new("technique", message)
            })?;
        Ok(Self {
            technique,
            storage: Storage::Fixed32,
            format,
            table: Some(table),
        })
    }

    /// The encoding of four moments in this format, which both `hamburger4` and `hausdorff4` read.
    #[must_use]
    pub fn of_four_moments(format: TextureFormat) -> Option<Self> {
        let storage = Storage::of_format(format)?;
        Self::new(Technique::Hamburger4, storage).ok()
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

    /// The meaning of the integers, if this is a summed-area table.
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
        self.technique.row().bounded_channels && self.storage == Storage::Float32
    }

    /// Texture layers that a layer of the map consists of.
    #[must_use]
    pub fn planes(&self) -> u32 {
        self.technique.row().planes
    }

    /// Bits of a texel of the map, all planes.
    #[must_use]
    pub fn bits_per_texel(&self) -> u32 {
        self.format.bytes_per_texel() * 8 * self.planes()
    }

    /// Checks that every device of the profile can write the map; the error names a storage to use instead.
    pub fn check(&self, profile: Profile) -> Result<(), ValueError> {
        let best = self.technique.best_storage(profile);
        let alternative = best.unwrap_or_else(|| Storage::best_for(profile));
        self.storage.check_format(self.format, profile, alternative)
    }
}

/// Names to choose from.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    names.collect::<Vec<_>>().join(" or ")
}

/// Checks that the exponents are within the range of the storage.
fn check_exponents(row: &Row, storage: Storage) -> Result<(), ValueError> {
    let Some(largest) = row.largest_exponent(storage) else {
        return Ok(());
    };
    for exponent in &row.exponents {
        if !(1.0..=largest).contains(&exponent.get()) {
            let message = format!(
                "'{}' has the exponent {exponent}; stored as {storage} it is from 1 to {largest}",
                row.name
            );
            return Err(ValueError::new("exponent", message));
        }
    }
    Ok(())
}

impl TryFrom<Pair> for MapEncoding {
    type Error = ValueError;

    fn try_from(pair: Pair) -> Result<Self, ValueError> {
        match (pair.storage, pair.table) {
            (Storage::Fixed32, Some(table)) => Self::of_table(pair.technique, table),
            (_, None) => Self::new(pair.technique, pair.storage),
            (storage, Some(_)) => {
                let message = format!(
                    "a summed-area table is stored as fixed32, not as {storage}; leave out 'table' for a map that is not a table"
                );
                Err(ValueError::new("storage", message))
            }
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
