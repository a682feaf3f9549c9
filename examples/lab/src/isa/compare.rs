//! The gate: no figure may grow beyond the table.

use core::fmt;

use super::chip::Chip;
use super::driver::Driver;
use super::figures::Row;
use super::table::Table;

/// Figures may differ by this much. Wider than the compiler's luck with one instruction, narrower than a change that
/// matters.
pub const TOLERANCE: f64 = 0.05;

/// A difference between a table and what a driver makes now.
#[derive(Clone, Debug, PartialEq)]
pub enum Difference {
    /// A figure is higher than in the table.
    Worse(Change),
    /// A figure is lower than in the table.
    Improved(Change),
    /// A shader that the table does not have.
    New {
        /// The chip.
        chip: Chip,
        /// The shader.
        shader: String,
    },
    /// A shader that only the table has.
    Gone {
        /// The chip.
        chip: Chip,
        /// The shader.
        shader: String,
    },
}

/// One figure of one shader.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The chip.
    pub chip: Chip,
    /// The shader.
    pub shader: String,
    /// The figure's name.
    pub figure: &'static str,
    /// What the table says.
    pub table: f64,
    /// What it is now.
    pub now: f64,
}

impl Difference {
    /// Whether the gate closes. An improvement passes.
    #[must_use]
    pub fn fails(&self) -> bool {
        !matches!(self, Difference::Improved(_))
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Difference::Worse(change) => write!(f, "worse: {change}"),
            Difference::Improved(change) => write!(f, "improved: {change}; update the table"),
            Difference::New { chip, shader } => {
                write!(
                    f,
                    "new: {chip}, {shader}: not in the table; update the table"
                )
            }
            Difference::Gone { chip, shader } => {
                write!(
                    f,
                    "gone: {chip}, {shader}: only in the table; update the table"
                )
            }
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Change {
            chip,
            shader,
            figure,
            table,
            now,
        } = self;
        write!(f, "{chip}, {shader}: {figure} {now} instead of {table}")?;
        if *table > 0.0 {
            write!(f, " ({:+.1} %)", 100.0 * (now / table - 1.0))?;
        }
        Ok(())
    }
}

/// Whether a table belongs to a driver.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Belongs {
    /// The very same library.
    Yes,
    /// The same version, built another time: figures should be the same.
    OtherBuild,
    /// Another compiler: figures cannot be compared.
    No,
}

/// Compares the drivers of a table and of now.
#[must_use]
pub fn belongs(table: &Driver, now: &Driver) -> Belongs {
    if table.name != now.name || table.version != now.version {
        Belongs::No
    } else if table.sha256 != now.sha256 {
        Belongs::OtherBuild
    } else {
        Belongs::Yes
    }
}

/// Everything that differs by more than [`TOLERANCE`], for the chips that were compiled now.
#[must_use]
pub fn compare(table: &Table, now: &Table) -> Vec<Difference> {
    let mut differences = Vec::new();
    for rows in &now.chips {
        let chip = rows.chip;
        let before: &[Row] = table
            .chips
            .iter()
            .find(|before| before.chip == chip)
            .map_or(&[], |before| &before.shaders);
        for row in &rows.shaders {
            match before.iter().find(|before| before.shader == row.shader) {
                Some(before) => compare_rows(chip, before, row, &mut differences),
                None => differences.push(Difference::New {
                    chip,
                    shader: row.shader.clone(),
                }),
            }
        }
        for row in before {
            if rows.shaders.iter().all(|now| now.shader != row.shader) {
                differences.push(Difference::Gone {
                    chip,
                    shader: row.shader.clone(),
                });
            }
        }
    }
    differences
}

fn compare_rows(chip: Chip, before: &Row, now: &Row, differences: &mut Vec<Difference>) {
    for ((figure, table), (_, value)) in before.figures.named().into_iter().zip(now.figures.named())
    {
        let change = || Change {
            chip,
            shader: now.shader.clone(),
            figure,
            table,
            now: value,
        };
        if value > table * (1.0 + TOLERANCE) {
            differences.push(Difference::Worse(change()));
        } else if value < table * (1.0 - TOLERANCE) {
            differences.push(Difference::Improved(change()));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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

    fn texts(before: u64, now: u64) -> Vec<(bool, String)> {
        compare(&table(&[("blur", before)]), &table(&[("blur", now)]))
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
        let differences = compare(&table(&[("old", 1)]), &table(&[("new", 1)]));
        assert_eq!(
            differences,
            [
                Difference::New {
                    chip: Chip::Navi21,
                    shader: "new".to_owned()
                },
                Difference::Gone {
                    chip: Chip::Navi21,
                    shader: "old".to_owned()
                },
            ]
        );
        assert!(differences.iter().all(Difference::fails));
    }

    #[test]
    fn a_table_belongs_to_a_version_and_not_to_a_build() {
        let table = driver("Mesa 1", "a");
        assert_eq!(belongs(&table, &driver("Mesa 1", "a")), Belongs::Yes);
        assert_eq!(belongs(&table, &driver("Mesa 1", "b")), Belongs::OtherBuild);
        assert_eq!(belongs(&table, &driver("Mesa 2", "a")), Belongs::No);
    }
}
