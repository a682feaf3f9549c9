//! Errors and costs of single scattering, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::cost::ScatteringCost;
use super::truth::MarchedRays;
use crate::cost::report::Conditions;

/// How ways to light the air of a scene compare.
#[derive(Clone, Debug, Serialize)]
pub struct ScatteringReport {
    /// The scene's name.
    pub scene: String,
    /// The viewpoint's name.
    pub look: String,
    /// Texels per side of the light's map.
    pub map: u32,
    /// Columns and rows of rectified maps.
    pub extent: [u32; 2],
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Steps of the truth.
    pub steps: u32,
    /// Optical thickness between the camera and the far end.
    pub thickness: f64,
    /// Mean radiance without shadows, by colour.
    pub unshadowed: [f64; 3],
    /// The share of it that shadows take.
    pub shadowed: f64,
    /// Seconds that the truths took.
    pub truth_seconds: f64,
    /// The candidates.
    pub rows: Vec<ScatteringRow>,
    /// How costs were taken, if they were.
    pub conditions: Option<Conditions>,
}

/// A candidate.
#[derive(Clone, Debug, Serialize)]
pub struct ScatteringRow {
    /// Its name.
    pub name: String,
    /// Whether it is made of the library's nodes.
    pub ours: bool,
    /// Fetches of maps per pixel.
    pub fetches: f64,
    /// Against rays through the plain map.
    pub plain: ScatteringError,
    /// Against rays through the filtered map.
    pub filtered: ScatteringError,
    /// Steps through the plain map at full resolution, if that is what it does.
    pub steps: Option<u32>,
    /// What it costs, if that was measured.
    pub cost: Option<ScatteringCost>,
}

/// Errors of in-scattered radiance over all pixels, as parts of the mean radiance without shadows, by colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ScatteringError {
    /// Mean absolute error.
    pub mean_absolute: [f64; 3],
    /// Mean of found less true: above 0 is too bright.
    pub mean: [f64; 3],
    /// The largest absolute error.
    pub largest: f64,
    /// Pixels that are no finite number.
    pub not_finite: usize,
}

impl ScatteringError {
    /// Of a picture against marched rays.
    #[must_use]
    pub fn of(found: &[[f32; 4]], truth: &MarchedRays) -> Self {
        let mut error = Self::default();
        let count = truth.radiance.len().max(1) as f64;
        for colour in 0..3 {
            let sum = |values: &[[f32; 3]]| -> f64 {
                values.iter().map(|value| f64::from(value[colour])).sum()
            };
            let scale = 1.0 / (sum(&truth.unshadowed) / count).max(1e-300);
            for (found, truth) in found.iter().zip(&truth.radiance) {
                let difference = scale * f64::from(found[colour] - truth[colour]);
                if difference.is_finite() {
                    error.mean_absolute[colour] += difference.abs() / count;
                    error.mean[colour] += difference / count;
                    error.largest = error.largest.max(difference.abs());
                }
            }
        }
        let broken = |pixel: &&[f32; 4]| pixel.iter().any(|value| !value.is_finite());
        error.not_finite = found.iter().filter(broken).count();
        error
    }

    /// The mean absolute error over all colours.
    #[must_use]
    pub fn overall(&self) -> f64 {
        self.mean_absolute.iter().sum::<f64>() / 3.0
    }
}

impl ScatteringReport {
    /// How many steps through the plain map at full resolution have the same error, by interpolation of logarithms: a number
    /// and -1, 0 or 1 where it is below, among or above those that were measured.
    #[must_use]
    pub fn equal_steps(&self, error: f64) -> Option<(f64, i32)> {
        let marched: Vec<(f64, f64)> = self
            .rows
            .iter()
            .filter_map(|row| Some((f64::from(row.steps?), row.plain.overall())))
            .collect();
        let (first, last) = (marched.first()?, marched.last()?);
        if error >= first.1 {
            return Some((first.0, -1));
        }
        if error <= last.1 {
            return Some((last.0, 1));
        }
        let pair = marched
            .windows(2)
            .find(|pair| error <= pair[0].1 && error >= pair[1].1)?;
        let part = (pair[0].1 / error).ln() / (pair[0].1 / pair[1].1).ln();
        Some((pair[0].0 * (pair[1].0 / pair[0].0).powf(part), 0))
    }
}

impl fmt::Display for ScatteringReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ([columns, rows], [width, height], map) = (self.extent, self.picture, self.map);
        writeln!(
            f,
            "{}, view {}: map {map}x{map}, rectified {columns}x{rows}, picture {width}x{height}, optical thickness {}; {:.0} % in \
             shadow; truths of {} steps in {:.1} s",
            self.scene,
            self.look,
            self.thickness,
            100.0 * self.shadowed,
            self.steps,
            self.truth_seconds,
        )?;
        writeln!(
            f,
            "{:<18} {:>7} {:>23} {:>8} {:>8} {:>9} {:>9} {:>6}",
            "mean absolute",
            "fetches",
            "red, green, blue",
            "bias",
            "largest",
            "filtered",
            "steps",
            "NaN"
        )?;
        for row in &self.rows {
            let [red, green, blue] = row.plain.mean_absolute;
            let bias = row.plain.mean.iter().sum::<f64>() / 3.0;
            let steps = match self.equal_steps(row.plain.overall()) {
                Some(_) if !row.ours => String::new(),
                Some((steps, -1)) => format!("< {steps:.0}"),
                Some((steps, 1)) => format!("> {steps:.0}"),
                Some((steps, _)) => format!("{steps:.0}"),
                None => String::new(),
            };
            writeln!(
                f,
                "{:<18} {:>7} {red:>7.4} {green:>7.4} {blue:>7.4} {bias:>+8.4} {:>8.3} {:>9.4} {steps:>9} {:>6}",
                row.name,
                row.fetches,
                row.plain.largest,
                row.filtered.overall(),
                row.plain.not_finite,
            )?;
        }
        if let Some(conditions) = &self.conditions {
            self.costs(f, conditions)?;
        }
        Ok(())
    }
}

impl ScatteringReport {
    fn costs(&self, f: &mut fmt::Formatter<'_>, conditions: &Conditions) -> fmt::Result {
        let first = self.rows.first().map_or("", |row| row.name.as_str());
        writeln!(f, "\n{conditions}")?;
        writeln!(
            f,
            "{:<18} {:>12} {:>6} {:>15} {:>6} {:>24}",
            "cost",
            "ns per pixel",
            "IQR",
            "ns per map texel",
            "IQR",
            format!("total x {first}")
        )?;
        let percent = |spread: f64| format!("{:.0} %", 100.0 * spread);
        for row in &self.rows {
            let Some(cost) = &row.cost else { continue };
            let map = cost.map;
            writeln!(
                f,
                "{:<18} {:>12.2} {:>6} {:>15} {:>6} {:>24.3}",
                row.name,
                cost.pixels.median,
                percent(cost.pixels.spread()),
                map.map_or("-".to_owned(), |map| format!("{:.2}", map.median)),
                map.map_or(String::new(), |map| percent(map.spread())),
                cost.total_ratio.median
            )?;
        }
        Ok(())
    }
}
