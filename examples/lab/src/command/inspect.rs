//! `moment-shadows-lab inspect`: one pixel, from the depths under its filter to what is shown.

use std::path::PathBuf;

use moment_shadows::Profile;

use super::render::RenderOptions;
use super::{CommandResult, print};
use crate::candidate::{TechniqueChoice, candidates};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::picture::{check_file, save_atomically};
use crate::trade::Trade;
use crate::trade::inspect::inspect;

/// What `inspect` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    frame: RenderOptions,
    /// A glTF or GLB file, or a procedural scene.
    scene: String,
    /// The pixel: column and row from the upper left corner.
    #[arg(long, value_name = "X,Y", value_parser = pixel)]
    pixel: [u32; 2],
    /// The graph file whose filter it is; the example of hard shadows by default.
    #[arg(long)]
    graph: Option<PathBuf>,
    /// A Gaussian of this radius, in texels, in place of the graph's own kernel.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Option<u32>,
    /// Techniques, each in all of its storages, in place of all that are filtered.
    #[arg(long, num_args = 1.., value_name = "NAME|JSON")]
    technique: Vec<TechniqueChoice>,
    /// A file for a picture of the depths and of what techniques show, as SVG.
    #[arg(long, value_name = "FILE.svg")]
    out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

fn pixel(text: &str) -> Result<[u32; 2], String> {
    let parts: Option<Vec<u32>> = text
        .split(',')
        .map(|part| part.trim().parse().ok())
        .collect();
    parts
        .and_then(|parts| parts.try_into().ok())
        .ok_or_else(|| "give column and row with a comma between them: 320,180".to_owned())
}

impl Options {
    /// Prints the steps, and draws them where a file is given.
    pub fn run(self) -> CommandResult {
        if let Some(out) = &self.out {
            check_file(out)?;
        }
        let mut file = match &self.graph {
            Some(path) => GraphFile::read(path, None)?,
            None => Trade::graph()?,
        };
        if let Some(radius) = self.radius {
            file = file.with_radius(radius)?;
        }
        let drawn = self.frame.drawn(&file)?;
        eprintln!("{drawn}");
        let scene = self.frame.load(&self.scene)?;
        let gpu = Gpu::open(Profile::NativeAdapter)?;
        let candidates = candidates(&self.technique, self.frame.storage)?;
        let options = (&self.frame, &drawn);
        let found = inspect(&gpu, &scene, options, &file, &candidates, self.pixel)?;
        if let Some(out) = &self.out {
            save_atomically(out, |file| file.write_all(found.svg().as_bytes()))?;
        }
        print(&found, self.json)
    }
}
