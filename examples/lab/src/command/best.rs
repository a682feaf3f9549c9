//! `moment-shadows-lab best`: what errs least for its bits in a trade that is finished.

use std::path::{Path, PathBuf};

use super::{CommandResult, print};
use crate::error::LabError;
use crate::picture::save_atomically;
use crate::trade::best::Record;
use crate::trade::results::Results;

/// What `best` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder of a finished trade.
    folder: PathBuf,
    /// Writes the record, which `Technique::best` and the tables in the documents are held to; in a checkout.
    #[arg(long)]
    update: bool,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// Where the record is.
#[must_use]
pub fn record() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("best.json")
}

impl Options {
    /// Prints the record, and writes it where that is asked for.
    pub fn run(self) -> CommandResult {
        let path = self.folder.join("results.json");
        let unusable = |error: &dyn core::fmt::Display| LabError::unsuitable(path.display(), error);
        let text = std::fs::read_to_string(&path).map_err(|error| unusable(&error))?;
        let results: Results = serde_json::from_str(&text)
            .map_err(|error| unusable(&format!("this is no finished trade: {error}")))?;
        let found = Record::of(&results);
        if self.update {
            let text = serde_json::to_string_pretty(&found)? + "\n";
            save_atomically(&record(), |file| file.write_all(text.as_bytes()))?;
        }
        print(&found, self.json)
    }
}
