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
    /// What differs, for which shader on which chip.
    pub text: String,
    /// Whether the gate closes. An improvement passes.
    pub fails: bool,
}

impl Difference {
    /// A shader that only the table has, or only the driver.
    fn of_names(change: &str, chip: Chip, shader: &str, whose: &str) -> Self {
        Self {
            text: format!("{change}: {chip}, {shader}: {whose} the table; update the table"),
            fails: true,
        }
    }

    /// A figure that differs by more than [`TOLERANCE`].
    fn of_figure(chip: Chip, shader: &str, name: &str, [table, now]: [f64; 2]) -> Option<Self> {
        let fails = now > table * (1.0 + TOLERANCE);
        if !fails && now >= table * (1.0 - TOLERANCE) {
            return None;
        }
        let change = if fails { "worse" } else { "improved" };
        let mut text = format!("{change}: {chip}, {shader}: {name} {now} instead of {table}");
        if table > 0.0 {
            text += &format!(" ({:+.1} %)", 100.0 * (now / table - 1.0));
        }
        if !fails {
            text += "; update the table";
        }
        Some(Self { text, fails })
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
        let chip = rows.chip;
        let before = table.chips.iter().find(|before| before.chip == chip);
        let before = before.map_or(&[][..], |before| &before.shaders);
        for Row { shader, figures } in &rows.shaders {
            let Some(before) = before.iter().find(|before| before.shader == *shader) else {
                differences.push(Difference::of_names("new", chip, shader, "not in"));
                continue;
            };
            let both = before.figures.named().into_iter().zip(figures.named());
            differences.extend(both.filter_map(|((name, _, table), (.., now))| {
                Difference::of_figure(chip, shader, name, [table, now])
            }));
        }
        for Row { shader, .. } in before {
            if rows.shaders.iter().all(|now| now.shader != *shader) {
                differences.push(Difference::of_names("gone", chip, shader, "only in"));
            }
        }
    }
    Some(Comparison {
        other_build: table.driver.sha256 != now.driver.sha256,
        differences,
        rows: now.chips.iter().map(|chip| chip.shaders.len()).sum(),
    })
}

impl Comparison {
    /// Whether no figure grew and no shader came or went.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.differences.iter().any(|difference| difference.fails)
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
            writeln!(f, "{}", difference.text)?;
        }
        let failed = self
            .differences
            .iter()
            .filter(|difference| difference.fails);
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
            .into_iter()
            .map(|difference| (difference.fails, difference.text))
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
        let texts = [
            "new: navi21, new: not in the table; update the table",
            "gone: navi21, old: only in the table; update the table",
        ];
        let expected = texts.map(|text| Difference {
            text: text.to_owned(),
            fails: true,
        });
        assert_eq!(differences, expected);
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
