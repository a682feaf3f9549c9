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

fn series<'a>(rows: impl Iterator<Item = &'a ErrorRow> + Clone) -> Vec<ErrorSeries> {
    let mut names: Vec<String> = Vec::new();
    for row in rows.clone() {
        let name = label(&row.errors.technique);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
        .into_iter()
        .map(|name| {
            let of_name = rows
                .clone()
                .filter(|row| label(&row.errors.technique) == name);
            ErrorSeries {
                points: points(of_name),
                name,
            }
        })
        .collect()
}

/// A point per storage and width of a texel, from few bits to many.
fn points<'a>(rows: impl Iterator<Item = &'a ErrorRow>) -> Vec<ErrorPoint> {
    let mut sums: Vec<(ErrorPoint, u32)> = Vec::new();
    for row in rows {
        let point = ErrorPoint {
            bits: row.errors.bits_per_texel,
            percent: 100.0 * row.errors.surfaces.shading.mean_absolute,
            storage: row.errors.storage,
        };
        let known = sums
            .iter_mut()
            .find(|(sum, _)| sum.bits == point.bits && sum.storage == point.storage);
        match known {
            Some((sum, count)) => {
                sum.percent += point.percent;
                *count += 1;
            }
            None => sums.push((point, 1)),
        }
    }
    let mut points: Vec<ErrorPoint> = sums
        .into_iter()
        .map(|(sum, count)| ErrorPoint {
            percent: sum.percent / f64::from(count),
            ..sum
        })
        .collect();
    points.sort_by_key(|point| point.bits);
    points
}
