//! Errors and costs of candidates, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::Cost;
use crate::cost::report::{Conditions, percent};
use crate::cost::table::columns;

/// Rows of cells after the names of their columns.
pub type Table = Vec<Vec<(&'static str, String)>>;

/// What candidates are judged by.
pub trait Errors: Serialize + Sized {
    /// The errors of all candidates.
    fn tables(rows: &[Row<Self>]) -> Vec<Table>;
}

/// How candidates compare on a scene.
#[derive(Clone, Debug, Serialize)]
pub struct Report<E> {
    /// The scene, and how it was drawn.
    pub setting: String,
    /// Seconds that the truth took.
    pub truth_seconds: f64,
    /// The candidates.
    pub rows: Vec<Row<E>>,
    /// How costs were taken, if they were.
    pub conditions: Option<Conditions>,
}

/// A candidate.
#[derive(Clone, Debug, Serialize)]
pub struct Row<E> {
    /// Its name.
    pub name: String,
    /// How far it is off.
    #[serde(flatten)]
    pub errors: E,
    /// What it costs, if that was measured.
    pub cost: Option<Cost>,
}

impl<E: Errors> fmt::Display for Report<E> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} in {:.1} s", self.setting, self.truth_seconds)?;
        for table in E::tables(&self.rows) {
            columns(f, &table)?;
        }
        let Some(conditions) = &self.conditions else {
            return Ok(());
        };
        writeln!(f, "\n{conditions}")?;
        let cells = |row: &Row<E>| {
            let cost = row.cost?;
            let ratio = |ratio: f64| format!("{ratio:.3}");
            let map = cost.map.map(|map| format!("{:.2}", map.median));
            Some(vec![
                ("nanoseconds", row.name.clone()),
                ("per pixel", format!("{:.2}", cost.pixels.median)),
                ("IQR", percent(cost.pixels.spread())),
                ("x first", ratio(cost.pixels_ratio.median)),
                ("map, per texel", map.unwrap_or("-".to_owned())),
                ("total x first", ratio(cost.total_ratio.median)),
            ])
        };
        columns(f, &self.rows.iter().filter_map(cells).collect::<Table>())
    }
}
