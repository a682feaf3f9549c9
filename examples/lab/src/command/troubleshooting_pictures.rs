//! `moment-shadows-lab troubleshooting-pictures`: what mistakes look like, beside the same picture without them.

use std::path::PathBuf;
use std::process::ExitCode;

use moment_shadows::Profile;

use super::CommandResult;
use crate::gpu::Gpu;
use crate::picture::{create_folder, save_panels};
use crate::progress;
use crate::troubleshooting::{NAMES, symptom};

/// What `troubleshooting-pictures` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder of the pictures; it is made if need be.
    #[arg(long)]
    out: PathBuf,
}

/// Width and height of a panel; a picture has two.
const PANEL: [u32; 2] = [318, 178];

impl Options {
    /// Makes the pictures.
    pub fn run(self) -> CommandResult {
        create_folder(&self.out)?;
        let gpu = Gpu::open(Profile::Native)?;
        let bar = progress::bar(NAMES.len() as u64, "drawing");
        for name in NAMES {
            let symptom = symptom(&gpu, name, PANEL)?;
            let panels = [symptom.wrong.picture, symptom.right.picture];
            save_panels(&self.out.join(format!("{name}.png")), &panels, PANEL, 2)?;
            bar.inc(1);
        }
        bar.finish_and_clear();
        Ok(ExitCode::SUCCESS)
    }
}
