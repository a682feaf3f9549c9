//! `moment-shadows isa`: what a real shader compiler makes of every shader, and the gate on it.

use std::path::Path;

use crate::isa::child;
use crate::isa::chip::Chip;
use crate::isa::compare::{Belongs, Difference, TOLERANCE, belongs, compare};
use crate::isa::error::IsaError;
use crate::isa::table::Table;

/// The table that is kept with the sources, from the root of a checkout.
pub const TABLE: &str = "examples/lab/isa/table.json";

/// What a check found.
pub struct Checked {
    /// How the table and the driver belong together; never [`Belongs::No`].
    pub belongs: Belongs,
    /// Everything that differs.
    pub differences: Vec<Difference>,
    /// Rows that were compared.
    pub rows: usize,
}

/// Compiles every shader for some chips.
pub fn table(chips: &[Chip]) -> Result<Table, IsaError> {
    child::table(chips)
}

/// Compares every shader with a table.
pub fn check(chips: &[Chip], path: &Path) -> Result<Checked, IsaError> {
    let before = Table::read(path)?;
    let now = child::table(chips)?;
    let belongs = belongs(&before.driver, &now.driver);
    if belongs == Belongs::No {
        return Err(IsaError::OtherDriver {
            path: path.display().to_string(),
            table: format!("{} {}", before.driver.name, before.driver.version),
            now: format!("{} {}", now.driver.name, now.driver.version),
        });
    }
    Ok(Checked {
        belongs,
        differences: compare(&before, &now),
        rows: now.chips.iter().map(|chip| chip.shaders.len()).sum(),
    })
}

/// Writes the table anew.
pub fn update(path: &Path) -> Result<(), IsaError> {
    child::table(&Chip::ALL)?.write(path)
}

impl Checked {
    /// Whether no figure grew and no shader came or went.
    #[must_use]
    pub fn passed(&self) -> bool {
        !self.differences.iter().any(Difference::fails)
    }
}

impl core::fmt::Display for Checked {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        if self.belongs == Belongs::OtherBuild {
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
            .filter(|difference| difference.fails())
            .count();
        let (rows, percent) = (self.rows, TOLERANCE * 100.0);
        if failed == 0 {
            writeln!(
                f,
                "no figure of {rows} rows is more than {percent} % above the table"
            )
        } else {
            writeln!(
                f,
                "the table of {rows} rows does not hold: {failed} above; if that is meant, run `isa --update` and say why in \
                 the commit"
            )
        }
    }
}
