//! Scores as a table and as JSON.

use core::fmt;
use std::path::Path;

use serde::Serialize;

use super::judge::{Acne, Scored, ViewScores};
use crate::error::LabError;
use crate::picture::save_atomically;
use crate::trade::results::{Setting, mean};

/// The version of the form of `scores.json`.
const VERSION: u32 = 1;

/// All scores, on each scene the best first.
#[derive(Clone, Debug, Serialize)]
pub struct Report {
    /// The form: 1.
    pub version: u32,
    /// What is the same for all scenes, as in `results.json` of a trade.
    pub setting: Setting,
    /// Combinations on scenes.
    pub rows: Vec<Scored>,
}

/// A figure of a view.
type Figure = fn(&ViewScores) -> Option<f64>;

/// The columns of figures: name, and what it is of a view.
const FIGURES: [(&str, Figure); 8] = [
    ("acne, const", |view| mean_of(&view.acne.constant)),
    ("acne", |view| mean_of(&view.acne.ours)),
    ("visible", |view| {
        view.acne.ours.as_ref().map(|acne| acne.visible)
    }),
    ("pan, const", |view| view.peter_panning.constant),
    ("pan", |view| view.peter_panning.ours),
    ("contact", |view| view.contact),
    ("flicker", |view| view.flicker.map(|it| it.mean)),
    ("worst", |view| view.flicker.map(|it| it.worst)),
];

/// Columns with our bias that say different things: their sum sorts the table.
const SORTED_BY: [usize; 4] = [1, 4, 5, 6];

fn mean_of(acne: &Option<Acne>) -> Option<f64> {
    acne.as_ref().map(|acne| acne.mean)
}

impl Scored {
    /// The mean over views of a column's figure.
    fn figure(&self, column: usize) -> Option<f64> {
        mean(self.views.iter().filter_map(FIGURES[column].1))
    }

    /// By what rows are sorted.
    fn sum(&self) -> f64 {
        let figures = SORTED_BY.iter().filter_map(|&column| self.figure(column));
        figures.sum()
    }
}

impl Report {
    /// Sorts rows, scene by scene in their order.
    pub(super) fn of(setting: Setting, mut rows: Vec<Scored>) -> Self {
        for of_scene in rows.chunk_by_mut(|one, other| one.scene == other.scene) {
            of_scene.sort_by(|one, other| one.sum().total_cmp(&other.sum()));
        }
        Self {
            version: VERSION,
            setting,
            rows,
        }
    }

    /// Writes `scores.json` into a folder.
    pub(super) fn save(&self, folder: &Path) -> Result<(), LabError> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        save_atomically(&folder.join("scores.json"), |out| {
            out.write_all(text.as_bytes())
        })
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for of_scene in self.rows.chunk_by(|one, other| one.scene == other.scene) {
            write!(
                f,
                "{}\n{:<22} {:<8} {:>5} {:>7} {:>6}",
                of_scene[0].scene, "technique", "storage", "map", "samples", "filter"
            )?;
            for (name, _) in FIGURES {
                write!(f, " {name:>11}")?;
            }
            writeln!(f)?;
            for row in of_scene {
                let storage = row.storage.map_or("depth", |storage| storage.name());
                let cell = row.cell;
                write!(
                    f,
                    "{:<22} {storage:<8} {:>5} {:>7} {:>6}",
                    row.name, cell.map, cell.samples, cell.radius
                )?;
                for column in 0..FIGURES.len() {
                    let figure = row.figure(column);
                    let figure = figure.map_or("-".to_owned(), |it| format!("{:.4}", 100.0 * it));
                    write!(f, " {figure:>11}")?;
                }
                writeln!(f)?;
            }
            writeln!(f)?;
        }
        write!(
            f,
            "Percent of full shadow; const: with a constant receiver bias. acne: false shadow on lit slopes of 0 to 80 degrees; visible: \
             percent of\ntheir pixels that are darker than a tenth. pan: what the bias takes of shadows at feet. contact: what is too light \
             around legs. flicker:\nchange per frame while the light's map slides by parts of a texel; worst: that of the worst frame. \
             Rows are sorted by the sum of\nacne, pan, contact and flicker."
        )
    }
}
