//! How a filterable map is encoded: a technique and a storage that go together.

use core::fmt;

use serde::{Deserialize, Serialize};

use super::{Row, Technique};
use crate::constants::TRANSLUCENT_CASTERS_MOST_BLENDS;
use crate::{
    BlendComponent, BlendState, Opacity, Profile, Storage, SummedAreaTable, TextureFormat,
    ValueError,
};

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
    #[serde(skip_serializing_if = "is_zero")]
    blends: u32,
    #[serde(skip_serializing_if = "is_false")]
    rounded_inwards: bool,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_false(flag: &bool) -> bool {
    !flag
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_zero(blends: &u32) -> bool {
    *blends == 0
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
    #[serde(default)]
    blends: u32,
    #[serde(default)]
    rounded_inwards: bool,
}

impl MapEncoding {
    /// The most translucent casters over each other that the moment bias is known for.
    pub const MOST_BLENDS: u32 = TRANSLUCENT_CASTERS_MOST_BLENDS;

    /// The encoding, if the storage is one of the technique's and its settings are within their ranges.
    pub fn new(technique: Technique, storage: Storage) -> Result<Self, ValueError> {
        Self::among(technique, storage, |row| row.storages.to_vec())
    }

    /// The encoding of a map in rectified coordinates, whose texels are means of many others that are rounded once (nodes
    /// `rectify_moments` and `integrate_scattering`): as [`new`](Self::new), and with storages that only suffice for these
    /// ([`Row::rectified`]).
    pub fn rectified(technique: Technique, storage: Storage) -> Result<Self, ValueError> {
        Self::among(technique, storage, |row| {
            [row.storages, row.rectified].concat()
        })
    }

    /// Whether the storage suffices for a map in rectified coordinates alone.
    #[must_use]
    pub fn is_rectified(&self) -> bool {
        self.technique.row().rectified.contains(&self.storage)
    }

    fn among(
        technique: Technique,
        storage: Storage,
        legal: impl Fn(&Row) -> Vec<Storage>,
    ) -> Result<Self, ValueError> {
        let row = technique.row();
        row.settings.clone()?;
        if row.reads_depth() {
            let message = format!(
                "'{technique}' reads the plain depth map, which needs no storage; connect the map to 'depth' of the node that \
                 shades"
            );
            return Err(ValueError::new("technique", message));
        }
        let legal = legal(&row);
        let format = storage
            .format_of(row.channels)
            .filter(|_| legal.contains(&storage))
            .ok_or_else(|| {
                let legal = listed(legal.iter().map(|legal| legal.name()));
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
            blends: 0,
            rounded_inwards: false,
        })
    }

    /// The same for a map whose texels are rounded inwards, to valid moments, as those are of the node `blur` that resolves (WGSL module
    /// `inward_rounding`): the bias of the bound is smaller. Refused for other techniques than `hamburger4` and other storages.
    pub fn rounded_inwards(self) -> Result<Self, ValueError> {
        let has_bias = self.technique.row().rounded_inwards.is_some();
        let is_coarse = matches!(self.storage, Storage::Unorm16 | Storage::Float16);
        if self.blends > 0 || !has_bias || !is_coarse {
            let message = format!(
                "{self}{}; texels are rounded inwards of maps for 'hamburger4' as unorm16 or float16, without 'blends'",
                if self.blends > 0 {
                    " with 'blends'"
                } else {
                    ""
                }
            );
            return Err(ValueError::new("rounded_inwards", message));
        }
        let rounded_inwards = true;
        Ok(Self {
            rounded_inwards,
            ..self
        })
    }

    /// The same for a map that is made of such texels, and rounded to all sides.
    #[must_use]
    pub fn rounded_again(self) -> Self {
        let rounded_inwards = false;
        Self {
            rounded_inwards,
            ..self
        }
    }

    /// Whether texels are rounded inwards.
    #[must_use]
    pub fn is_rounded_inwards(&self) -> bool {
        self.rounded_inwards
    }

    /// The same for a map that up to so many translucent casters are blended into, one after the other at any texel, far to near from the
    /// light: every blend rounds, and the bias of the bound grows with their number.
    /// Refused, if the technique's texels are no means that blending keeps, or its bias is not known for so many.
    pub fn with_blends(self, blends: u32) -> Result<Self, ValueError> {
        let refused = |message| Err(ValueError::new("blends", message));
        let technique = &self.technique;
        if blends > 0
            && (self.table.is_some()
                || self.storage.is_packed()
                || self.is_rectified()
                || technique.row().blended.is_none())
        {
            let all = Technique::examples();
            let others = all.iter().filter(|other| other.row().blended.is_some());
            let what = match self.table {
                Some(_) => "a summed-area table".to_owned(),
                None if self.storage.is_packed() => format!("packed texels ('{}')", self.storage),
                None if self.is_rectified() => "a map in rectified coordinates".to_owned(),
                None => format!("a map for '{technique}'"),
            };
            return refused(format!(
                "translucent casters are not blended into {what}; they are into maps for {}",
                listed(others.map(Technique::name))
            ));
        }
        if blends > Self::MOST_BLENDS {
            return refused(format!(
                "{blends} translucent casters over each other; the moment bias is known for up to {}",
                Self::MOST_BLENDS
            ));
        }
        // Each blend rounds to all sides.
        let rounded_inwards = self.rounded_inwards && blends == 0;
        Ok(Self {
            blends,
            rounded_inwards,
            ..self
        })
    }

    /// How many translucent casters are blended into the map over each other, at most.
    #[must_use]
    pub fn blends(&self) -> u32 {
        self.blends
    }

    /// How a host's pipelines blend translucent casters into the map, all planes alike: a state for each draw of a caster.
    /// Refused, if the map does not leave its fourth channel free for [`Opacity::Alpha`], or has more than the one texture layer that
    /// [`Opacity::SecondSource`] can draw to.
    pub fn blend_states(&self, opacity: Opacity) -> Result<Vec<BlendState>, ValueError> {
        let row = self.technique.row();
        let refused = |why: &str| {
            let message = format!("a map for '{}' {why}", self.technique);
            Err(ValueError::new("opacity", message))
        };
        let Some(blended) = row.blended.filter(|_| self.table.is_none()) else {
            return refused("is none that translucent casters are blended into");
        };
        if opacity == Opacity::Alpha && !blended.alpha_is_free {
            return refused(
                "has four moments in its four channels, so that none is left for the opacity; use Opacity::SecondSource, \
                 Opacity::TwoDraws, or Opacity::Constant for draws of one opacity",
            );
        }
        if opacity == Opacity::SecondSource && row.planes > 1 {
            return refused(
                "has several texture layers, but a fragment with a second source draws to one; its fourth channel is free: use \
                 Opacity::Alpha",
            );
        }
        let state = |&color: &BlendComponent| BlendState {
            color,
            alpha: if blended.alpha_is_free {
                BlendComponent::KEEP
            } else {
                color
            },
        };
        Ok(opacity.components().iter().map(state).collect())
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
            blends: 0,
            rounded_inwards: false,
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

    /// Whether blurs of a radius in texels sum its texels with the WGSL module `split_sum`: moments within [-1, 1] whose
    /// storage is as fine as sums of f32 are. Packed texels bring no rounding of their own to the sums, so that their bias covers
    /// those of 9 texels.
    #[must_use]
    pub fn has_split_sums(&self, radius: u32) -> bool {
        let is_fine = self.storage == Storage::Float32 || (self.storage.is_packed() && radius > 4);
        self.technique.row().bounded_channels && is_fine
    }

    /// Whether samplers and mip levels can average its texels.
    #[must_use]
    pub fn averaged_by_samplers(&self) -> bool {
        self.technique.row().averaged_by_samplers && !self.storage.is_packed()
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
        let encoding = match (pair.storage, pair.table) {
            (Storage::Fixed32, Some(table)) => Self::of_table(pair.technique, table),
            (_, None) => Self::rectified(pair.technique, pair.storage),
            (storage, Some(_)) => {
                let message = format!(
                    "a summed-area table is stored as fixed32, not as {storage}; leave out 'table' for a map that is not a table"
                );
                Err(ValueError::new("storage", message))
            }
        };
        let encoding = encoding?.with_blends(pair.blends)?;
        match pair.rounded_inwards {
            true => encoding.rounded_inwards(),
            false => Ok(encoding),
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
