//! The table as text.

use core::fmt;

use super::figures::Figures;
use super::table::Table;

const REMARK: &str = "\
instr to latency: the compiler's figures per invocation (loops by a fixed factor). VALU to store: executed per output,
loops by their trip counts. cyc: cycles per 64 outputs that keep each unit of an RDNA 2 compute unit busy, in a model.";

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.chips.iter().flat_map(|chip| &chip.shaders);
        let width = names.map(|row| row.shader.len()).max().unwrap_or_default();
        for chip in &self.chips {
            write!(f, "{:width$}", chip.chip.name())?;
            for (_, head, _) in Figures::default().named() {
                write!(f, " {head:>7}")?;
            }
            writeln!(f)?;
            for row in &chip.shaders {
                write!(f, "{:width$}", row.shader)?;
                for (index, (.., value)) in row.figures.named().into_iter().enumerate() {
                    // The compiler's figures are whole numbers.
                    let decimals = usize::from(index >= 7);
                    write!(f, " {value:>7.decimals$}")?;
                }
                writeln!(f)?;
            }
            writeln!(f)?;
        }
        let driver = &self.driver;
        writeln!(f, "{REMARK}")?;
        writeln!(
            f,
            "driver {}, {}, sha256 {}",
            driver.name, driver.version, driver.sha256
        )
    }
}
