//! What is varied: maps, softness, samples, techniques with their storages.

use moment_shadows::{Profile, Storage};
use serde::{Deserialize, Serialize};
use serde_json::json;

use super::results::AxesSetting;
use crate::candidate::Candidate;
use crate::error::LabError;
use crate::graph_file::{GraphFile, LARGEST_RESOLVED_RADIUS};

/// The axes of a trade. Every value of each is combined with all others.
#[derive(Clone, Debug)]
pub struct Axes {
    /// Texels per side of the light's map, ascending.
    pub maps: Vec<u32>,
    /// How soft shadows are filtered: the radius of a Gaussian in texels of the largest map, whose standard deviation is 0.6 of it.
    /// In smaller maps it is as wide in the scene.
    pub radii: Vec<u32>,
    /// Samples per texel of the light's map. Tests on the plain depth map have one.
    pub samples: Vec<u32>,
    /// Techniques with storages, in the order of tables.
    pub candidates: Vec<Candidate>,
}

/// One combination, for all views of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Cell {
    /// Texels per side of the light's map.
    pub map: u32,
    /// Samples per texel.
    pub samples: u32,
    /// The radius in texels of the largest map.
    pub radius: u32,
    /// The number of the candidate.
    pub candidate: usize,
}

impl Axes {
    /// The largest map, which truths are made for.
    #[must_use]
    pub fn largest_map(&self) -> u32 {
        self.maps.iter().copied().max().unwrap_or(1024)
    }

    /// Texels that the largest map keeps free at each border, so that every filter of every map finds the far end there.
    #[must_use]
    pub fn margin(&self) -> f64 {
        let widest = self.radii.iter().copied().max().unwrap_or(0);
        let smallest = self.maps.iter().copied().min().unwrap_or(1);
        // A lookup between texels and the rounding of a radius take two texels of the smallest.
        f64::from(widest) + 2.0 * f64::from(self.largest_map()) / f64::from(smallest.max(1))
    }

    /// Every combination, map by map and softness by softness, but for filters that are wider than a map written once can have.
    #[must_use]
    pub fn cells(&self) -> Vec<Cell> {
        let mut cells = Vec::new();
        for &map in &self.maps {
            for &samples in &self.samples {
                for &radius in &self.radii {
                    for (candidate, of) in self.candidates.iter().enumerate() {
                        let is_once = of.storage().is_some_and(Storage::is_written_once);
                        if is_once && self.width(map, radius) > f64::from(LARGEST_RESOLVED_RADIUS) {
                            continue;
                        }
                        let samples = if of.reads_depth() { 1 } else { samples };
                        let cell = Cell {
                            map,
                            samples,
                            radius,
                            candidate,
                        };
                        if !cells.contains(&cell) {
                            cells.push(cell);
                        }
                    }
                }
            }
        }
        // What is drawn alike is measured in a row.
        cells.sort_by_key(|cell| (cell.map, cell.samples));
        cells
    }

    /// The number of a cell's radius.
    #[must_use]
    pub fn softness(&self, cell: Cell) -> usize {
        let softness = self.radii.iter().position(|&radius| radius == cell.radius);
        softness.unwrap_or(0)
    }

    /// The graph of a cell.
    pub fn graph(&self, file: &GraphFile, cell: Cell) -> Result<GraphFile, LabError> {
        let blurred = self.blurred(file, cell.map, cell.radius)?;
        self.candidates[cell.candidate].graph(&blurred)
    }

    /// The radius in texels of a map of `map` texels that is `radius` in the largest.
    fn width(&self, map: u32, radius: u32) -> f64 {
        f64::from(radius) * f64::from(map) / f64::from(self.largest_map())
    }

    /// A graph whose filter is as wide in a map of `map` texels as a radius in the largest.
    pub fn blurred(&self, file: &GraphFile, map: u32, radius: u32) -> Result<GraphFile, LabError> {
        let width = self.width(map, radius);
        let kernel = json!({ "radius": width.ceil().max(1.0) as u32, "sigma": 0.6 * width });
        file.with_kernel(&kernel)
    }

    /// The values of all axes.
    #[must_use]
    pub fn described(&self) -> AxesSetting {
        let Self {
            maps,
            radii,
            samples,
            candidates,
        } = self.clone();
        AxesSetting {
            maps,
            radii,
            samples,
            candidates: candidates.iter().map(Candidate::to_string).collect(),
        }
    }

    /// Whether a device of a profile makes the map of a candidate.
    #[must_use]
    pub fn offers(profile: Profile, candidate: &Candidate) -> bool {
        candidate.profile_with(profile) == profile
    }
}
