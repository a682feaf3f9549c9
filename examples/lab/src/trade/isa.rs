//! What the kept table says of the shader that shades with a technique.

use moment_shadows::{Storage, Technique};

use super::results::Isa;
use crate::error::LabError;
use crate::isa::chip::Chip;
use crate::isa::table::Table;
use crate::techniques::label;

/// The rows of the kept table for one chip of RDNA 2.
pub struct Kept(Table);

impl Kept {
    /// The table that is kept with the sources of the instrument.
    pub fn read() -> Result<Self, LabError> {
        Ok(Self(serde_json::from_str(include_str!(
            "../../isa/table.json"
        ))?))
    }

    /// The figures of hard shading with a technique; `None` where the table has no row for it.
    #[must_use]
    pub fn shading(&self, technique: &Technique, storage: Option<Storage>) -> Option<Isa> {
        // Taps are known by their kind alone, and cost by their number.
        if technique.reads_depth() && !Technique::examples().contains(technique) {
            return None;
        }
        let label = label(technique);
        let settings = match storage {
            None => label,
            Some(storage) if *technique == Technique::Hamburger4 && !storage.is_packed() => {
                format!("{storage}, sampled")
            }
            Some(storage) => format!("{label}, {storage}"),
        };
        let name = format!("shade_hard, {settings}: shade");
        let mut chips = self.0.chips.iter();
        let rows = chips.find(|rows| rows.chip == Chip::Navi21)?;
        let row = rows.shaders.iter().find(|row| row.shader == name)?;
        Some(Isa {
            inverse_throughput: row.figures.inverse_throughput,
            vgprs: row.figures.vgprs,
            texture: row.figures.texture,
        })
    }
}
