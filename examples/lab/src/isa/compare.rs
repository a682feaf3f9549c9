//! The gate: no figure may grow beyond the table.

use core::fmt;

use super::chip::Chip;
use super::figures::Row;
use super::table::Table;

/// Figures may differ by this much. Wider than the compiler's luck with one instruction, narrower than a change that
/// matters.
pub const TOLERANCE: f64 = 0.05;

/// A difference between a table and what a driver makes now.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// The chip.
    pub chip: Chip,
    /// The shader.
    pub shader: String,
    /// What differs.
    pub change: Change,
}

/// What differs for a shader.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// The table does not have the shader.
    New,
    /// Only the table has the shader.
    Gone,
    /// A figure has changed.
    Figure {
        /// Its name.
        name: &'static str,
        /// What the table says.
        table: f64,
        /// What the figure is now.
        now: f64,
    },
}

impl Difference {
    /// Whether the gate closes. An improvement passes.
    #[must_use]
    pub fn fails(&self) -> bool {
        !matches!(self.change, Change::Figure { table, now, .. } if now < table)
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Difference { chip, shader, .. } = self;
        match &self.change {
            Change::New => write!(
                f,
                "new: {chip}, {shader}: not in the table; update the table"
            ),
            Change::Gone => write!(
                f,
                "gone: {chip}, {shader}: only in the table; update the table"
            ),
            Change::Figure { name, table, now } => {
                let kind = if self.fails() { "worse" } else { "improved" };
                write!(
                    f,
                    "{kind}: {chip}, {shader}: {name} {now} instead of {table}"
                )?;
                if *table > 0.0 {
                    write!(f, " ({:+.1} %)", 100.0 * (now / table - 1.0))?;
                }
                f.write_str(if self.fails() {
                    ""
                } else {
                    "; update the table"
                })
            }
        }
    }
}

/// How a driver compares with the one that made a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// Whether the driver is another build of the same version: figures should be the same.
    pub other_build: bool,
    /// Everything that differs by more than [`TOLERANCE`], for the chips that were compiled now.
    pub differences: Vec<Difference>,
    /// Rows that were compared.
    pub rows: usize,
}

/// Compares tables; `None` where the drivers' versions differ, whose figures cannot be compared.
#[must_use]
pub fn compare(table: &Table, now: &Table) -> Option<Comparison> {
    if (&table.driver.name, &table.driver.version) != (&now.driver.name, &now.driver.version) {
        return None;
    }
    let mut differences = Vec::new();
    for rows in &now.chips {
        let before = table.chips.iter().find(|before| before.chip == rows.chip);
        let before = before.map_or(&[][..], |before| &before.shaders);
        let mut push = |row: &Row, change| {
            differences.push(Difference {
                chip: rows.chip,
                shader: row.shader.clone(),
                change,
            });
        };
        for row in &rows.shaders {
            match before.iter().find(|before| before.shader == row.shader) {
                Some(before) => figures(before, row).for_each(|figure| push(row, figure)),
                None => push(row, Change::New),
            }
        }
        for row in before {
            if rows.shaders.iter().all(|now| now.shader != row.shader) {
                push(row, Change::Gone);
            }
        }
    }
    Some(Comparison {
        other_build: table.driver.sha256 != now.driver.sha256,
        differences,
        rows: now.chips.iter().map(|chip| chip.shaders.len()).sum(),
    })
}

/// The figures that differ by more than [`TOLERANCE`].
fn figures(before: &Row, now: &Row) -> impl Iterator<Item = Change> {
    let figures = before.figures.named().into_iter().zip(now.figures.named());
    figures.filter_map(|((name, _, table), (.., now))| {
        let differs = now > table * (1.0 + TOLERANCE) || now < table * (1.0 - TOLERANCE);
        differs.then_some(Change::Figure { name, table, now })
    })
}

impl Comparison {
    /// Whether no figure grew and no shader came or went.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.differences.iter().any(Difference::fails)
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.other_build {
            writeln!(
                f,
                "warning: the table was made by another build of the same driver version"
            )?;
        }
        for difference in &self.differences {
            writeln!(f, "{difference}")?;
        }
        let failed = self
            .differences
            .iter()
            .filter(|difference| difference.fails());
        let (rows, percent) = (self.rows, TOLERANCE * 100.0);
        match failed.count() {
            0 => writeln!(
                f,
                "no figure of {rows} rows is more than {percent} % above the table"
            ),
            failed => writeln!(
                f,
                "the table of {rows} rows does not hold: {failed} above; if that is meant, run `isa --update` and say why in \
                 the commit"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::driver::Driver;
    use crate::isa::figures::Figures;
    use crate::isa::table::ChipRows;

    fn driver(version: &str, sha256: &str) -> Driver {
        Driver {
            name: "radv".to_owned(),
            version: version.to_owned(),
            sha256: sha256.to_owned(),
        }
    }

    /// A table of one chip with shaders of these instruction counts.
    fn table(shaders: &[(&str, u64)]) -> Table {
        let row = |&(shader, instructions): &(&str, u64)| Row {
            shader: shader.to_owned(),
            figures: Figures {
                instructions,
                ..Figures::default()
            },
        };
        Table {
            driver: driver("1", "a"),
            chips: vec![ChipRows {
                chip: Chip::Navi21,
                shaders: shaders.iter().map(row).collect(),
            }],
        }
    }

    fn differences(before: &[(&str, u64)], now: &[(&str, u64)]) -> Vec<Difference> {
        let compared = compare(&table(before), &table(now));
        compared
            .map(|compared| compared.differences)
            .unwrap_or_default()
    }

    fn texts(before: u64, now: u64) -> Vec<(bool, String)> {
        differences(&[("blur", before)], &[("blur", now)])
            .iter()
            .map(|difference| (difference.fails(), difference.to_string()))
            .collect()
    }

    #[test]
    fn a_figure_that_grows_by_more_than_the_tolerance_fails() {
        assert_eq!(texts(100, 105), []);
        let text = "worse: navi21, blur: instructions 106 instead of 100 (+6.0 %)";
        assert_eq!(texts(100, 106), [(true, text.to_owned())]);
        let text = "worse: navi21, blur: instructions 1 instead of 0";
        assert_eq!(texts(0, 1), [(true, text.to_owned())]);
    }

    #[test]
    fn a_figure_that_shrinks_asks_for_a_new_table() {
        assert_eq!(texts(100, 95), []);
        let text =
            "improved: navi21, blur: instructions 94 instead of 100 (-6.0 %); update the table";
        assert_eq!(texts(100, 94), [(false, text.to_owned())]);
    }

    #[test]
    fn shaders_that_come_and_go_fail() {
        let differences = differences(&[("old", 1)], &[("new", 1)]);
        let difference = |shader: &str, change| Difference {
            chip: Chip::Navi21,
            shader: shader.to_owned(),
            change,
        };
        assert_eq!(
            differences,
            [
                difference("new", Change::New),
                difference("old", Change::Gone)
            ]
        );
        assert!(differences.iter().all(Difference::fails));
    }

    #[test]
    fn a_table_belongs_to_a_version_and_not_to_a_build() {
        let before = Table {
            driver: driver("Mesa 1", "a"),
            chips: Vec::new(),
        };
        for (version, sha256, other_build) in [
            ("Mesa 1", "a", Some(false)),
            ("Mesa 1", "b", Some(true)),
            ("Mesa 2", "a", None),
        ] {
            let now = Table {
                driver: driver(version, sha256),
                chips: Vec::new(),
            };
            let compared = compare(&before, &now);
            assert_eq!(compared.map(|compared| compared.other_build), other_build);
        }
    }
}
