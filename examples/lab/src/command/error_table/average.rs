//! The chart of a table: errors averaged over its scenes.

use moment_shadows::Storage;

use super::ErrorRow;
use crate::command::error::{Setting, storage_name};
use crate::plot::{Axis, Chart, Panel, Series};
use crate::techniques::{STORAGES, label};

/// The share of a doubling of bits by which neighbouring series stand apart, so that none covers another.
const APART: f64 = 0.045;

/// A panel per radius, in it each technique's mean over the scenes of its mean absolute error over all surfaces, and a point
/// per storage and width of a texel, from few bits to many.
#[must_use]
pub fn error_chart(rows: &[ErrorRow], setting: &Setting) -> Chart {
    let mut radii: Vec<u32> = rows.iter().map(|row| row.radius).collect();
    radii.sort_unstable();
    radii.dedup();
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene.as_str()).collect();
    scenes.sort_unstable();
    scenes.dedup();
    let panel = |radius: u32| panel(radius, rows.iter().filter(|row| row.radius == radius));
    Chart {
        title: "Error over all surfaces against bits per texel".to_owned(),
        setting: format!("mean over {}; {}", scenes.join(", "), setting.drawn),
        panels: radii.into_iter().map(panel).collect(),
        markers: storages().map(storage_name).collect(),
    }
}

/// The plain depth map and all storages: which of them a marker stands for.
fn storages() -> impl Iterator<Item = Option<Storage>> {
    core::iter::once(None).chain(STORAGES.map(Some))
}

fn panel<'a>(radius: u32, rows: impl Iterator<Item = &'a ErrorRow> + Clone) -> Panel {
    let mut names: Vec<String> = Vec::new();
    for row in rows.clone() {
        let name = label(&row.errors.technique);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let middle = 0.5 * (names.len() as f64 - 1.0);
    let series: Vec<Series> = (0..)
        .zip(names)
        .map(|(index, name)| {
            let of_name = |row: &&ErrorRow| label(&row.errors.technique) == name;
            let apart = APART * (f64::from(index) - middle);
            Series {
                points: points(rows.clone().filter(of_name), apart),
                name,
            }
        })
        .collect();
    let bits = rows.map(|row| f64::from(row.errors.bits_per_texel).log2());
    let (low, high) = bits.fold((f64::INFINITY, 0.0_f64), |(low, high), bits| {
        (low.min(bits), high.max(bits))
    });
    let errors = series.iter().flat_map(|line| &line.points);
    let largest = errors.map(|point| point.1).fold(0.0, f64::max);
    Panel {
        title: format!("radius {radius}"),
        axes: [
            Axis {
                name: "bits per texel",
                range: low.min(high).floor() - 0.5..high.ceil() + 0.5,
                labels: 8,
                label: Box::new(|bits| bits.exp2().to_string()),
            },
            Axis {
                name: "mean absolute error (percent)",
                range: 0.0..1.05 * largest.max(1e-3),
                labels: 8,
                label: Box::new(f64::to_string),
            },
        ],
        label_width: 56,
        series,
    }
}

fn points<'a>(rows: impl Iterator<Item = &'a ErrorRow>, apart: f64) -> Vec<(f64, f64, usize)> {
    // The sum of errors in percent and their number, by bits and marker.
    let mut sums = std::collections::BTreeMap::<(u32, usize), (f64, f64)>::new();
    for ErrorRow { errors, .. } in rows {
        let marker = storages().position(|storage| storage == errors.storage);
        let key = (errors.bits_per_texel, marker.unwrap_or(0));
        let (sum, count) = sums.entry(key).or_default();
        *sum += 100.0 * errors.surfaces.shading.mean_absolute;
        *count += 1.0;
    }
    let point =
        |((bits, marker), (sum, count))| (f64::from(bits).log2() + apart, sum / count, marker);
    sums.into_iter().map(point).collect()
}
