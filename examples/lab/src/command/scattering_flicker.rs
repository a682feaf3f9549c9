//! `moment-shadows scattering-flicker`: what flickers in the air while camera and light move.

use core::fmt;

use serde::Serialize;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::progress;
use crate::scattering::{Flicker, FlickerDesc, GOAL, PROFILE, STILL, WINDOW, flicker};
use crate::scene;

/// Which scenes, and what is drawn of them.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct FlickerOptions {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(long, required = true, num_args = 1..)]
    pub scene: Vec<String>,
    /// What is drawn.
    #[command(flatten)]
    pub desc: FlickerDesc,
    /// Prints JSON.
    #[arg(long)]
    pub json: bool,
}

/// What flickers in several scenes.
#[derive(Clone, Debug, Serialize)]
pub struct FlickerReport {
    /// Flicker by scene.
    pub scenes: Vec<Flicker>,
}

/// Walks the path in each scene: glTF files or names of procedural scenes.
pub fn run(options: &FlickerOptions) -> Result<FlickerReport, LabError> {
    let gpu = Gpu::open(PROFILE)?;
    let desc = &options.desc;
    let scenes = (options.scene.iter())
        .map(|name| {
            let scene = scene::load(name)?;
            let bar = progress::bar(u64::from(desc.frames), name);
            let found = flicker(&gpu, &scene, desc, || bar.inc(1));
            bar.finish_and_clear();
            found
        })
        .collect::<Result<_, LabError>>()?;
    Ok(FlickerReport { scenes })
}

impl FlickerReport {
    /// Whether filtering does in every scene what is asked of it.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.scenes.iter().all(|scene| scene.ratio() <= GOAL)
    }
}

impl fmt::Display for FlickerReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for scene in &self.scenes {
            let verdict = if scene.ratio() <= GOAL {
                "ok"
            } else {
                "goal missed"
            };
            writeln!(
                f,
                "{scene}filtered / unfiltered {:.3}  {verdict}\n",
                scene.ratio()
            )?;
        }
        writeln!(
            f,
            "Changes of radiance between successive frames, in parts of the mean radiance without shadows, in a static region: pixels \
             whose truth,\nmarched through a finer map with shadows and without, changes by at most {STILL} per frame there and for \
             {WINDOW} frame before and\nafter. part: of what flickers without filters. ok: the largest change is at most a third of \
             that."
        )
    }
}
