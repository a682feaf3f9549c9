//! `moment-shadows-lab sweep`: how techniques scale with map, picture and filter.

use std::path::PathBuf;

use moment_shadows::Profile;
use moment_shadows_graph::command::argument::named;

use super::{CommandResult, print};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::picture::{create_folder, save_atomically};
use crate::progress;
use crate::scene::PROCEDURAL;
use crate::sweep::{Point, Sweep};

/// What `sweep` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A glTF or GLB file, or a procedural scene.
    #[arg(default_value = PROCEDURAL[0])]
    scene: String,
    /// Fewer and smaller places on all axes: a minute instead of a quarter of an hour.
    #[arg(long)]
    quick: bool,
    /// What the device offers.
    #[arg(long, value_parser = named(Profile::ALL, Profile::name), default_value = "native")]
    profile: Profile,
    /// A folder for the chart and the figures; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Sweeps, prints ratios, and draws the chart where a folder is given.
    pub fn run(self) -> CommandResult {
        if let Some(out) = &self.out {
            create_folder(out)?;
        }
        let sweep = Sweep {
            scene: self.scene,
            profile: self.profile,
            maps: match self.quick {
                true => vec![256, 512],
                false => vec![256, 512, 1024, 2048, 4096],
            },
            pictures: match self.quick {
                true => vec![[160, 90], [320, 180]],
                false => vec![[640, 360], [1280, 720], [1920, 1080], [3840, 2160]],
            },
            filters: match self.quick {
                true => vec![3, 9, 17],
                false => vec![3, 5, 9, 17, 33, 65, 129],
            },
            held: match self.quick {
                true => Point {
                    map: 256,
                    picture: [160, 90],
                    filter: 9,
                },
                false => Point {
                    map: 1024,
                    picture: [1280, 720],
                    filter: 9,
                },
            },
            picture_of_filters: if self.quick { [160, 90] } else { [320, 180] },
            rounds: FEWEST_ROUNDS,
        };
        let bar = progress::bar(sweep.steps(), "sweeping");
        let swept = sweep.run(|| bar.inc(1))?;
        bar.finish_and_clear();
        if let Some(out) = &self.out {
            swept.chart().save(out, "sweep")?;
            let text = serde_json::to_string_pretty(&swept)? + "\n";
            save_atomically(&out.join("sweep.json"), |file| {
                file.write_all(text.as_bytes())
            })?;
        }
        print(&swept, self.json)
    }
}
