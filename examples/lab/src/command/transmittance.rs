//! `moment-shadows-lab transmittance`: translucent casters against the exact transmittance.

use std::path::PathBuf;

use super::{CommandResult, print};
use crate::picture::check_picture;
use crate::scene::load_blended;
use crate::translucent::{
    SceneTransmittance, TranslucentStage, TransmittanceReport, costs, picture, plumes, stacks,
};

/// What `transmittance` takes.
#[derive(clap::Args)]
pub struct Options {
    /// Casters over each other.
    #[arg(long, value_delimiter = ',', default_value = "1,2,4,8,16", value_parser = clap::value_parser!(u32).range(1..=64))]
    casters: Vec<u32>,
    /// A picture of a plume of smoke beside the truth.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Prints what blending them takes instead, in a map of 1024 texels per side, beside drawing as many opaque casters.
    #[arg(long, conflicts_with_all = ["scene", "out"])]
    cost: bool,
    /// A glTF or GLB file whose translucent materials (BLEND) are blended instead, under the sun of a numbered view.
    #[arg(long, conflicts_with_all = ["casters", "out"])]
    scene: Option<String>,
    /// One of the numbered viewpoints and light directions of the scene.
    #[arg(long, default_value_t = 0, requires = "scene")]
    view: u32,
    /// Texels per side of the scene's map.
    #[arg(long, default_value_t = 256, requires = "scene", value_parser = clap::value_parser!(u32).range(16..=2048))]
    map: u32,
    /// Leaves out the scene's ground plane.
    #[arg(long, requires = "scene")]
    no_ground: bool,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// Texels per side of the stacks' maps, and of the plume's.
const SIDES: [u32; 2] = [64, 192];

/// Texels per side of the maps whose time is taken.
const SIDE_OF_COST: u32 = 1024;

impl Options {
    /// Blends casters into every map, prints how far its bound is from the truth, and draws the picture.
    pub fn run(self) -> CommandResult {
        if let Some(name) = &self.scene {
            let mut scene = load_blended(name)?;
            if self.no_ground {
                scene = scene.without_ground();
            }
            let stage = TranslucentStage::new(self.map)?;
            let report = SceneTransmittance::of(&stage, &scene, self.view)?;
            return print(&report, self.json);
        }
        if self.cost {
            let stage = TranslucentStage::new(SIDE_OF_COST)?;
            return print(&costs(&stage, &self.casters)?, self.json);
        }
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
