//! The plot of a table: errors averaged over its scenes.

use super::ErrorRow;
use crate::command::error::Setting;
use crate::error_plot::{ErrorPanel, ErrorPlot, ErrorPoint, ErrorSeries};
use crate::techniques::label;

/// A panel per radius, in it each technique's mean over the scenes of its mean absolute error over all surfaces.
#[must_use]
pub fn error_plot(rows: &[ErrorRow], setting: &Setting) -> ErrorPlot {
    let mut radii: Vec<u32> = rows.iter().map(|row| row.radius).collect();
    radii.sort_unstable();
    radii.dedup();
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene.as_str()).collect();
    scenes.dedup();
    scenes.sort_unstable();
    scenes.dedup();
    ErrorPlot {
        title: "Error over all surfaces against bits per texel".to_owned(),
        setting: format!(
            "mean over {}; map {}x{}, {} samples per texel",
            scenes.join(", "),
            setting.map,
            setting.map,
            setting.samples
        ),
        panels: radii
            .into_iter()
            .map(|radius| ErrorPanel {
                title: format!("radius {radius}"),
                series: series(rows.iter().filter(|row| row.radius == radius)),
            })
            .collect(),
    }
}

/// A series per technique, in the order of their rows.
fn series<'a>(rows: impl Iterator<Item = &'a ErrorRow>) -> Vec<ErrorSeries> {
    let mut all: Vec<(ErrorSeries, Vec<u32>)> = Vec::new();
    for ErrorRow { errors, .. } in rows {
        let name = label(&errors.technique);
        let known = all.iter().position(|(series, _)| series.name == name);
        let (series, counts) = match known {
            Some(known) => &mut all[known],
            None => {
                let points = Vec::new();
                all.push((ErrorSeries { name, points }, Vec::new()));
                let last = all.len() - 1;
                &mut all[last]
            }
        };
        let point = ErrorPoint {
            bits: errors.bits_per_texel,
            percent: 100.0 * errors.surfaces.shading.mean_absolute,
            storage: errors.storage,
        };
        let same = |sum: &ErrorPoint| (sum.bits, sum.storage) == (point.bits, point.storage);
        match series.points.iter().position(same) {
            Some(known) => {
                series.points[known].percent += point.percent;
                counts[known] += 1;
            }
            None => {
                series.points.push(point);
                counts.push(1);
            }
        }
    }
    let mean = |(mut series, counts): (ErrorSeries, Vec<u32>)| {
        for (point, count) in series.points.iter_mut().zip(counts) {
            point.percent /= f64::from(count);
        }
        series.points.sort_by_key(|point| point.bits);
        series
    };
    all.into_iter().map(mean).collect()
}
