//! `moment-shadows shaders`: every linked shader as a file, for other compilers to judge.

use std::path::PathBuf;

use crate::shaders::{self, ShadersError};

/// What `shaders` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder to make.
    #[arg(long)]
    out: PathBuf,
}

/// Writes every shader of the library into the new folder, and says how many they are.
///
/// # Errors
/// [`ShadersError`]; there is then no folder.
pub fn run(options: &Options) -> Result<(), ShadersError> {
    let all = shaders::all()?;
    shaders::write(&all, &options.out)?;
    println!("{} shaders in {}", all.len(), options.out.display());
    Ok(())
}
