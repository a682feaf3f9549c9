//! What a report tells of single scattering.

use serde::Serialize;

use super::truth::MarchedRays;
use crate::compare::{Errors, Row, Table};
use crate::metric::{NO_PIXEL, percent};

/// How far a picture is off.
#[derive(Clone, Debug, Serialize)]
pub struct ScatteringErrors {
    /// Whether it is made of the library's nodes.
    pub ours: bool,
    /// Fetches of maps per pixel.
    pub fetches: f64,
    /// Errors against rays through the plain map.
    pub plain: ScatteringError,
    /// Errors against rays through the filtered map.
    pub filtered: ScatteringError,
    /// Steps through the plain map at full resolution, if that is what it does.
    pub steps: Option<u32>,
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
    /// Pixels that are non-finite.
    pub not_finite: usize,
}

impl ScatteringError {
    /// The error of a picture against marched rays.
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

impl Errors for ScatteringErrors {
    fn tables(rows: &[Row<Self>]) -> Vec<Table> {
        let cells = |row: &Row<ScatteringErrors>| {
            let errors = &row.errors;
            let [red, green, blue] = errors.plain.mean_absolute.map(|it| percent(it, NO_PIXEL));
            let bias = errors.plain.mean.iter().sum::<f64>() / 3.0;
            let steps = equal_steps(rows, errors.plain.overall()).filter(|_| errors.ours);
            let steps = steps.map(|(steps, side)| match side {
                -1 => format!("< {steps:.0}"),
                1 => format!("> {steps:.0}"),
                _ => format!("{steps:.0}"),
            });
            vec![
                ("percent of mean radiance", row.name.clone()),
                ("fetches", errors.fetches.to_string()),
                ("red", red),
                ("green", green),
                ("blue", blue),
                ("bias", format!("{:+.3}", 100.0 * bias)),
                ("largest", percent(errors.plain.largest, NO_PIXEL)),
                ("filtered", percent(errors.filtered.overall(), NO_PIXEL)),
                ("steps", steps.unwrap_or("-".to_owned())),
                ("NaN", errors.plain.not_finite.to_string()),
            ]
        };
        vec![rows.iter().map(cells).collect()]
    }
}

/// How many steps through the plain map at full resolution have the same error, by interpolation of logarithms: a number
/// and -1, 0 or 1 where it is below, among or above those that were measured.
fn equal_steps(rows: &[Row<ScatteringErrors>], error: f64) -> Option<(f64, i32)> {
    let marched: Vec<(f64, f64)> = rows
        .iter()
        .map(|row| &row.errors)
        .filter_map(|errors| Some((f64::from(errors.steps?), errors.plain.overall())))
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
