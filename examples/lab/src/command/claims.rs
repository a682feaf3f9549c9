//! `moment-shadows-lab claims`: what papers say, measured, with a verdict each.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use super::CommandResult;
use crate::claims::{Extent, judge, table::CLAIMS};
use crate::picture::{create_folder, save_atomically};

/// What `claims` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A folder for the table, as `claims.md` and `claims.json`; it is made if need be.
    #[arg(long)]
    out: PathBuf,
    /// Small maps and pictures of one scene: whether everything works, within a minute. Verdicts mean little then.
    #[arg(long)]
    quick: bool,
    /// Writes the record, which the table in the documents is held to; in a checkout.
    #[arg(long, conflicts_with = "quick")]
    update: bool,
}

/// Where the record is.
#[must_use]
pub fn record() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("claims.json")
}

impl Options {
    /// Measures, judges, prints the table and writes it.
    pub fn run(self) -> CommandResult {
        create_folder(&self.out)?;
        let extent = match self.quick {
            true => Extent::Quick,
            false => Extent::Full,
        };
        let found = judge(CLAIMS, extent)?;
        let table = found.to_string();
        let text = serde_json::to_string_pretty(&found)? + "\n";
        let mut files = vec![
            (self.out.join("claims.md"), &table),
            (self.out.join("claims.json"), &text),
        ];
        files.extend(self.update.then(|| (record(), &text)));
        for (path, text) in files {
            save_atomically(&path, |file| file.write_all(text.as_bytes()))?;
        }
        print!("{table}");
        Ok(ExitCode::SUCCESS)
    }
}
