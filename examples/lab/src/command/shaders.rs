//! `moment-shadows-lab shaders`: every linked shader as a file, for other compilers to judge.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use crate::shaders;

/// What `shaders` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder to make.
    #[arg(long)]
    out: PathBuf,
}

impl Options {
    /// Writes every shader of the library into the new folder, and says how many they are.
    pub fn run(self) -> CommandResult {
        let all = shaders::all()?;
        shaders::write(&all, &self.out)?;
        println!("{} shaders in {}", all.len(), self.out.display());
        Ok(ExitCode::SUCCESS)
    }
}
