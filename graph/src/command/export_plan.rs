//! `moment-shadows export-plan`: the compiled plan of a graph file, as JSON.

use std::path::PathBuf;
use std::process::ExitCode;

use moment_shadows::Profile;

use super::{CommandError, GraphFile, Part, argument, output};
use crate::Capabilities;

/// What `export-plan` takes.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// The graph file.
    file: PathBuf,
    /// What the plan may rely on.
    #[arg(long, value_parser = argument::profile(), default_value = "native")]
    profile: Profile,
    /// The file to write, whole or not at all, instead of the output.
    #[arg(long)]
    out: Option<PathBuf>,
}

impl Options {
    /// Compiles the file and writes its plan.
    ///
    /// # Errors
    /// [`CommandError`] if the graph is not valid, or the plan cannot be written.
    pub fn run(self) -> Result<ExitCode, CommandError> {
        // An output that cannot be written is refused before the work.
        let part = self.out.as_deref().map(Part::beside).transpose()?;
        let capabilities = Capabilities::of_profile(self.profile);
        let plan = GraphFile::read(&self.file)?.compile(&capabilities)?;
        let text = serde_json::to_string_pretty(&plan)?;
        match part {
            None => output::print(text)?,
            Some(part) => part.write(|file| writeln!(file, "{text}"))?.keep()?,
        }
        Ok(ExitCode::SUCCESS)
    }
}
