//! `moment-shadows-lab scattering-flicker`: what flickers in the air while camera and light move.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use crate::gpu::Gpu;
use crate::picture::{create_folder, save_panels};
use crate::progress;
use crate::scattering::{Flicker, FlickerDesc, PROFILE, STILL, WINDOW, flicker};
use crate::scene;

/// What `scattering-flicker` takes.
#[derive(clap::Args)]
pub struct Options {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(long, required = true, num_args = 1..)]
    scene: Vec<String>,
    #[command(flatten)]
    desc: FlickerDesc,
    /// A folder for a picture of each scene: the two frames between which most changes with view rays, and the change, by the truth,
    /// the filtered chain, that with view rays and the unfiltered one; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Walks the path in each scene and prints what flickers; fails where filtering does not do what is asked of it.
    pub fn run(self) -> CommandResult {
        if let Some(out) = &self.out {
            create_folder(out)?;
        }
        let gpu = Gpu::open(PROFILE)?;
        let mut found = Vec::new();
        for name in &self.scene {
            let scene = scene::load(name)?;
            let bar = progress::bar(u64::from(self.desc.frames), name);
            let walked = flicker(&gpu, &scene, &self.desc, || bar.inc(1))?;
            bar.finish_and_clear();
            if let Some(out) = &self.out {
                let path = out.join(format!("{}-flicker.png", walked.scene));
                let size = [self.desc.width, self.desc.height];
                save_panels(&path, &walked.pictures, size, 3)?;
            }
            found.push(walked);
        }
        if self.json {
            let report = serde_json::json!({ "scenes": found });
            println!("{}", serde_json::to_string_pretty(&report)?);
        } else {
            found.iter().for_each(|scene| println!("{scene}"));
            println!(
                "Changes of radiance between successive frames, in parts of the mean radiance without shadows, in a static region: \
                 pixels whose truth,\nmarched through a finer map with shadows and without, changes by at most {STILL} per frame there \
                 and for {WINDOW} frame before and\nafter. part: of what flickers without filters. ok: the largest change is at most \
                 a third of that."
            );
        }
        Ok(match found.iter().all(Flicker::passed) {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        })
    }
}
