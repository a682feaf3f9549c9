//! What errs least for its bits, over all that a trade has judged: the record that `Technique::best` goes by.

use core::fmt;

use moment_shadows::{MapEncoding, Profile, Storage, Technique};
use serde::{Deserialize, Serialize};

use super::results::Results;
use crate::cost::table::Columns;

/// Techniques in storages, the least error first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// What was judged.
    pub scenes: Vec<String>,
    /// How many views of each.
    pub views: u32,
    /// Radii of filters, in texels of the map.
    pub radii: Vec<u32>,
    /// Texels per side of the map, and samples per texel.
    pub map: [u32; 2],
    /// The adapter and its driver.
    pub adapter: String,
    /// The rows.
    pub rows: Vec<Recorded>,
}

/// A technique in a storage.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Recorded {
    /// The technique's name, which stands for its usual settings.
    pub technique: String,
    /// The storage.
    pub storage: Storage,
    /// Bits of a texel, all planes.
    pub bits: u32,
    /// The geometric mean over scenes, views and filters of the mean absolute error over pixels that face the light, in percent.
    pub error: f64,
    /// The same over all surfaces.
    pub surfaces: f64,
}

impl Record {
    /// The record of a trade: its largest map with the most samples, and the usual settings of each technique.
    #[must_use]
    pub fn of(results: &Results) -> Self {
        let axes = &results.setting.axes;
        let most = |values: &[u32]| values.iter().copied().max().unwrap_or(0);
        let map = [most(&axes.maps), most(&axes.samples)];
        let mut rows = Vec::new();
        for encoding in usual() {
            let is_it = |row: &&super::results::Row| {
                row.storage == Some(encoding.storage())
                    && row.technique == *encoding.technique()
                    && [row.cell.map, row.cell.samples] == map
            };
            let rows_of = || {
                let all = results.scenes.iter().flat_map(|scene| &scene.rows);
                all.filter(is_it).flat_map(|row| &row.views)
            };
            let pictures = rows_of().filter_map(|view| view.picture);
            let surfaces = rows_of().filter_map(|view| view.surfaces);
            let error = geometric_mean(pictures.map(|it| 100.0 * it.error));
            let of_surfaces = geometric_mean(surfaces.map(|it| 100.0 * it.error));
            if let (Some(error), Some(surfaces)) = (error, of_surfaces) {
                rows.push(Recorded {
                    technique: encoding.technique().name().to_owned(),
                    storage: encoding.storage(),
                    bits: encoding.bits_per_texel(),
                    error,
                    surfaces,
                });
            }
        }
        rows.sort_by(|one, other| one.error.total_cmp(&other.error));
        Self {
            scenes: results
                .scenes
                .iter()
                .map(|scene| scene.scene.clone())
                .collect(),
            views: results.setting.views[0],
            radii: axes.radii.clone(),
            map,
            adapter: results.setting.adapter.clone(),
            rows,
        }
    }

    /// The row with the least error among those of at most so many bits that every device of a profile makes.
    #[must_use]
    pub fn best(&self, profile: Profile, bits: u32) -> Option<&Recorded> {
        self.rows.iter().find(|row| {
            let is_it = |encoding: &MapEncoding| {
                encoding.technique().name() == row.technique && encoding.storage() == row.storage
            };
            let encoding = usual().into_iter().find(is_it);
            row.bits <= bits && encoding.is_some_and(|it| it.check(profile).is_ok())
        })
    }
}

/// Every filterable technique with the settings that its name stands for, in every storage.
fn usual() -> Vec<MapEncoding> {
    let mut techniques: Vec<Technique> = Vec::new();
    for technique in Technique::examples() {
        if techniques
            .iter()
            .all(|known| known.name() != technique.name())
        {
            techniques.push(technique);
        }
    }
    let in_storages = techniques.iter().flat_map(|technique| {
        let storages = Storage::ALL.into_iter();
        storages.filter_map(|storage| MapEncoding::new(technique.clone(), storage).ok())
    });
    in_storages.collect()
}

fn geometric_mean(figures: impl Iterator<Item = f64>) -> Option<f64> {
    super::results::mean(figures.map(f64::ln)).map(f64::exp)
}

impl fmt::Display for Record {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let cells = |row: &Recorded| {
            vec![
                ("technique", row.technique.clone()),
                ("storage", row.storage.name().to_owned()),
                ("bits", row.bits.to_string()),
                ("picture %", format!("{:.3}", row.error)),
                ("all surfaces %", format!("{:.3}", row.surfaces)),
            ]
        };
        write!(
            f,
            "{}",
            Columns(&Vec::from_iter(self.rows.iter().map(cells)))
        )
    }
}
