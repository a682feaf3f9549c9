//! `moment-shadows-lab transmittance`: translucent casters against the exact transmittance.

use std::path::PathBuf;

use super::{CommandResult, print};
use crate::picture::check_picture;
use crate::translucent::{TranslucentStage, TransmittanceReport, picture, plumes, stacks};

/// What `transmittance` takes.
#[derive(clap::Args)]
pub struct Options {
    /// Casters over each other.
    #[arg(long, value_delimiter = ',', default_value = "1,2,4,8,16", value_parser = clap::value_parser!(u32).range(1..=64))]
    casters: Vec<u32>,
    /// A picture of a plume of smoke beside the truth.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// Texels per side of the stacks' maps, and of the plume's.
const SIDES: [u32; 2] = [64, 192];

impl Options {
    /// Blends casters into every map, prints how far its bound is from the truth, and draws the picture.
    pub fn run(self) -> CommandResult {
        if let Some(path) = &self.out {
            check_picture(path)?;
        }
        let [of_stacks, of_plume] = SIDES.map(TranslucentStage::new);
        let of_plume = of_plume?;
        let report = TransmittanceReport {
            stacks: stacks(&of_stacks?, &self.casters)?,
            plumes: plumes(&of_plume)?,
        };
        if let Some(path) = &self.out {
            picture(&of_plume, path)?;
        }
        print(&report, self.json)
    }
}
