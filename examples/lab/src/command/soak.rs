//! `moment-shadows-lab soak`: a session over many frames that change everything.

use std::process::ExitCode;

use moment_shadows::Profile;

use super::{CommandResult, print};
use crate::gpu::Gpu;
use crate::progress;
use crate::soak::{self, SoakDesc};

/// What `soak` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    desc: SoakDesc,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Goes on for so many frames and prints what became of it; ends with 3 where a new session shows something else, or memory grows.
    pub fn run(self) -> CommandResult {
        let gpu = Gpu::open(Profile::Native)?;
        let bar = progress::bar(u64::from(self.desc.frames), "frames");
        let found = soak::run(&gpu, &self.desc, || bar.inc(1))?;
        bar.finish_and_clear();
        let passed = found.passed();
        print(&found, self.json)?;
        Ok(if passed {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(3)
        })
    }
}
