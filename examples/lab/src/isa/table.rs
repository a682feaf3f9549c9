//! The table: every shader on every chip, and the driver that compiled them.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::chip::Chip;
use super::driver::Driver;
use super::figures::Row;
use crate::error::LabError;
use crate::picture::save_atomically;

/// The shaders of one chip.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChipRows {
    /// The chip.
    pub chip: Chip,
    /// A row per shader.
    pub shaders: Vec<Row>,
}

/// What a driver makes of the shaders.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Table {
    /// The driver.
    pub driver: Driver,
    /// Its code for each chip.
    pub chips: Vec<ChipRows>,
}

impl Table {
    /// Reads a table.
    pub fn read(path: &Path) -> Result<Table, LabError> {
        let text = std::fs::read_to_string(path).map_err(|error| {
            let way = "run the command from a checkout, or name a table with `--table`; `isa --update` makes one";
            LabError::unsuitable(path.display(), format!("{error}; {way}"))
        })?;
        serde_json::from_str(&text).map_err(|error| {
            let reason = format!("it is no ISA table: {error}; make a new one with `isa --update`");
            LabError::unsuitable(path.display(), reason)
        })
    }

    /// Writes the table beside `path` and renames it, so that an existing one is never half-replaced.
    pub fn write(&self, path: &Path) -> Result<(), LabError> {
        let text = self.to_json()?;
        save_atomically(path, |file| file.write_all(text.as_bytes()))
    }

    /// JSON with one row per line, so that a difference between two tables can be read.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        let mut chips = Vec::new();
        for rows in &self.chips {
            let shaders: Vec<String> = rows
                .shaders
                .iter()
                .map(|row| Ok(format!("        {}", serde_json::to_string(row)?)))
                .collect::<Result<_, serde_json::Error>>()?;
            chips.push(format!(
                "    {{\n      \"chip\": {},\n      \"shaders\": [\n{}\n      ]\n    }}",
                serde_json::to_string(&rows.chip)?,
                shaders.join(",\n")
            ));
        }
        Ok(format!(
            "{{\n  \"driver\": {},\n  \"chips\": [\n{}\n  ]\n}}\n",
            serde_json::to_string(&self.driver)?,
            chips.join(",\n")
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::isa::figures::Figures;

    fn table() -> Table {
        let row = |shader: &str, valu| Row {
            shader: shader.to_owned(),
            figures: Figures {
                valu,
                ..Figures::default()
            },
        };
        Table {
            driver: Driver {
                name: "radv".to_owned(),
                version: "Mesa 1".to_owned(),
                sha256: "00".to_owned(),
            },
            chips: Chip::ALL
                .into_iter()
                .map(|chip| ChipRows {
                    chip,
                    shaders: vec![row("a", 0.1), row("b", 12.375)],
                })
                .collect(),
        }
    }

    #[test]
    fn a_table_that_was_written_is_read_again() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.json");
        table().write(&path)?;
        assert_eq!(Table::read(&path)?, table());
        Ok(())
    }

    #[test]
    fn a_table_is_the_same_text_every_time() {
        let text = table().to_json().unwrap_or_default();
        assert_eq!(text, table().to_json().unwrap_or_default());
        assert_eq!(
            text.lines()
                .filter(|line| line.contains("\"shader\""))
                .count(),
            4
        );
    }

    #[test]
    fn what_is_no_table_names_the_file_and_the_way_out() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("table.json");
        for text in [None, Some("{}"), Some("{\"driver\": 1}")] {
            if let Some(text) = text {
                std::fs::write(&path, text)?;
            }
            let error = Table::read(&path).err().map(|error| error.to_string());
            let error = error.unwrap_or_default();
            assert!(
                error.contains("table.json") && error.contains("isa --update"),
                "{error}"
            );
        }
        Ok(())
    }
}
