//! `moment-shadows-lab scores`: acne, peter-panning, contact and flicker of every technique.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use super::trade::{Varied, ascending};
use crate::picture::create_folder;
use crate::progress;
use crate::scene::{CHAIRS, SLOPES};
use crate::scores::{STEP, Scores};
use crate::trade::Job;

/// What `scores` takes.
#[derive(clap::Args)]
pub struct Options {
    /// glTF or GLB files, or procedural scenes. Contact is judged on chairs alone, whose feet are known.
    #[arg(default_values = [SLOPES, CHAIRS])]
    scene: Vec<String>,
    /// A folder for scores.json and a picture of each score; it is made if need be.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Radii of the filter, in texels of the largest map.
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=64), default_values_t = [4])]
    radius: Vec<u32>,
    /// The constant receiver bias that ours is compared with, in widths of a texel. By default what ours is on a slope of 45 degrees.
    #[arg(long, value_name = "TEXELS", value_parser = not_negative)]
    constant_bias: Option<f64>,
    /// A graph of hard shadows in place of `examples/hard_shadows.json`, of which technique, storage and radius are varied.
    #[arg(long, value_name = "FILE")]
    graph: Option<PathBuf>,
    /// What else is varied.
    #[command(flatten)]
    varied: Varied,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

fn not_negative(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number: &f64| number.is_finite());
    number
        .filter(|&number| number >= 0.0)
        .ok_or_else(|| "give a number that is not negative".to_owned())
}

impl Options {
    /// Scores, and prints a table.
    pub fn run(self) -> CommandResult {
        if let Some(folder) = &self.out {
            create_folder(folder)?;
        }
        let radii = ascending(&self.radius);
        let trade = (self.varied).trade(self.scene, radii, vec![Job::Hard])?;
        let steps = trade.scenes.len() * trade.axes.cells().len();
        let bar = progress::bar(steps as u64, "scoring");
        let scores = Scores {
            trade,
            graph: self.graph,
            constant: self.constant_bias,
            step: STEP,
        };
        let report = scores.run(self.out.as_deref(), || bar.inc(1))?;
        bar.finish_and_clear();
        match self.json {
            true => println!("{}", serde_json::to_string_pretty(&report)?),
            false => println!("{report}"),
        }
        Ok(ExitCode::SUCCESS)
    }
}
