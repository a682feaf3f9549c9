//! `moment-shadows-lab choose`: the graph for a scene and bounds.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use super::trade::Varied;
use crate::picture::{check_file, create_folder, save_atomically};
use crate::trade::choose::{Bounds, Choice};
use crate::trade::{Job, Trade};

/// The exit code where nothing keeps to the bounds.
const NOTHING: u8 = 3;

/// What `choose` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A glTF or GLB file, or a procedural scene.
    scene: String,
    /// A folder for what is measured, with a page; it is made if need be. What is there already is not measured again, so that other
    /// bounds take no time.
    #[arg(long)]
    out: PathBuf,
    #[command(flatten)]
    bounds: BoundArguments,
    /// The graph file to write.
    #[arg(long, value_name = "FILE.json")]
    graph: Option<PathBuf>,
    /// The radius of the filter, in texels of the largest map.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: u32,
    #[command(flatten)]
    varied: Varied,
}

/// At least one bound.
#[derive(clap::Args)]
#[group(required = true, multiple = true)]
struct BoundArguments {
    /// The largest mean error of shadow intensity in pictures, in percent of full shadow. The time is made least then.
    #[arg(long, value_name = "PERCENT", value_parser = above_zero)]
    max_error: Option<f64>,
    /// The most bytes of all textures and buffers of the graph.
    #[arg(long, value_name = "BYTES", value_parser = clap::value_parser!(u64).range(1..))]
    max_bytes: Option<u64>,
    /// The longest time, in copies of a map of 1024 x 1024 texels of 64 bits by a compute shader.
    #[arg(long, value_name = "COPIES", value_parser = above_zero)]
    max_time: Option<f64>,
}

fn above_zero(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number
        .filter(|&number| number > 0.0)
        .ok_or_else(|| "give a number above 0".to_owned())
}

impl Options {
    /// Measures, prints the table and the reasons, and writes the graph.
    pub fn run(self) -> CommandResult {
        create_folder(&self.out)?;
        if let Some(graph) = &self.graph {
            check_file(graph)?;
        }
        let trade = (self.varied).trade(vec![self.scene], vec![self.radius], vec![Job::Hard])?;
        let results = trade.run(&self.out)?;
        let bounds = Bounds {
            error: self.bounds.max_error,
            bytes: self.bounds.max_bytes,
            time: self.bounds.max_time,
        };
        let choice = Choice::of(&results.scenes[0], self.radius, bounds);
        print!("{choice}");
        println!();
        for reason in choice.reasons(&results) {
            println!("{reason}");
        }
        let Some(chosen) = choice.chosen() else {
            return Ok(NOTHING.into());
        };
        if let Some(path) = &self.graph {
            let file = trade.axes.graph(&Trade::graph()?, chosen.cell)?;
            let text = choice.graph(&file, chosen.cell, &results)?;
            save_atomically(path, |out| out.write_all(text.as_bytes()))?;
            println!("{}", path.display());
        }
        Ok(ExitCode::SUCCESS)
    }
}
