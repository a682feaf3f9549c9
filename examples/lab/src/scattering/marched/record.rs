//! What is recorded of ways to light the air: what the library chooses by.

use std::path::{Path, PathBuf};

use moment_shadows::{AirLight, ScatteringWay};
use serde::{Deserialize, Serialize};

use super::candidate::MarchCandidate;
use super::lamp::Lamp;
use super::report::MarchErrors;
use crate::compare::Report;
use crate::error::LabError;
use crate::picture::save_atomically;

/// The record of some scenes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaysRecord {
    /// The scenes, each as often as the others.
    pub scenes: Vec<String>,
    /// Of each light and medium, the least error first.
    pub rows: Vec<WayRow>,
}

/// A way, and how far it is off.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WayRow {
    /// The light.
    pub light: AirLight,
    /// Whether its air is homogeneous.
    pub homogeneous: bool,
    /// The way.
    pub way: ScatteringWay,
    /// Lookups of the filtered map per pixel.
    pub lookups: f64,
    /// The mean absolute error as a part of the mean radiance without shadows, over colours and scenes.
    pub error: f64,
}

/// Where the record is.
#[must_use]
pub fn ways_record() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scattering_ways.json")
}

impl WaysRecord {
    /// Adds what reports of scenes say of a light.
    pub(crate) fn add(
        &mut self,
        (lamp, falloff): (Lamp, f64),
        candidates: &[MarchCandidate],
        reports: &[Report<MarchErrors>],
    ) {
        let mut rows = Vec::new();
        for candidate in candidates {
            let Some(way) = candidate.way else { continue };
            let all = reports.iter().flat_map(|report| &report.rows);
            let errors: Vec<f64> = all
                .filter(|row| row.name == candidate.name)
                .map(|row| row.errors.error.overall())
                .collect();
            rows.push(WayRow {
                light: lamp.air_light(),
                homogeneous: falloff == 0.0,
                way,
                lookups: candidate.lookups,
                // Four digits are what two runs have in common with room to spare.
                error: (1e4 * errors.iter().sum::<f64>() / errors.len().max(1) as f64).round()
                    / 1e4,
            });
        }
        rows.sort_by(|a, b| (a.error.total_cmp(&b.error)).then(a.lookups.total_cmp(&b.lookups)));
        self.rows.extend(rows);
    }

    /// Writes it into the checkout.
    pub(crate) fn save(&self) -> Result<(), LabError> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        save_atomically(&ways_record(), |file| file.write_all(text.as_bytes()))
    }
}
