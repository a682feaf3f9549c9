//! Errors and costs of candidates, as text and as JSON.

use core::fmt;

use serde::Serialize;

use super::Cost;
use crate::cost::report::{Conditions, percent};
use crate::cost::table::columns;

/// Rows of cells after the names of their columns.
pub type Table = Vec<Vec<(&'static str, String)>>;

/// What a report tells of a stage; its text is the report's first line.
pub trait Setting: Serialize + fmt::Display {
    /// What candidates are judged by.
    type Errors: Serialize;
    /// What the column of the map's cost is called, with its unit.
    const MAP_COST: &'static str;

    /// What names of files begin with.
    fn stem(&self) -> String;

    /// The errors of all candidates.
    fn tables(&self, rows: &[Row<Self::Errors>]) -> Vec<Table>;
}

/// How candidates compare on a scene.
#[derive(Clone, Debug, Serialize)]
#[serde(bound = "")]
pub struct Report<S: Setting> {
    /// Setting of the stage.
    #[serde(flatten)]
    pub setting: S,
    /// Seconds that the truth took.
    pub truth_seconds: f64,
    /// The candidates.
    pub rows: Vec<Row<S::Errors>>,
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

impl<S: Setting> fmt::Display for Report<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{} in {:.1} s", self.setting, self.truth_seconds)?;
        for table in self.setting.tables(&self.rows) {
            columns(f, &table)?;
        }
        let Some(conditions) = &self.conditions else {
            return Ok(());
        };
        writeln!(f, "\n{conditions}")?;
        let cells = |row: &Row<S::Errors>| {
            let cost = row.cost?;
            let ratio = |ratio: f64| format!("{ratio:.3}");
            let map = cost.map.map(|map| format!("{:.2}", map.median));
            Some(vec![
                ("nanoseconds", row.name.clone()),
                ("per pixel", format!("{:.2}", cost.pixels.median)),
                ("IQR", percent(cost.pixels.spread())),
                ("x first", ratio(cost.pixels_ratio.median)),
                (S::MAP_COST, map.unwrap_or("-".to_owned())),
                ("total x first", ratio(cost.total_ratio.median)),
            ])
        };
        columns(f, &self.rows.iter().filter_map(cells).collect::<Table>())
    }
}
