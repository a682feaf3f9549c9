//! `moment-shadows-lab trade`: what techniques cost and how far they are off on scenes, as a page.

use std::path::PathBuf;
use std::process::ExitCode;

use moment_shadows::{Profile, ValueError};
use moment_shadows_graph::command::argument::named;

use super::CommandResult;
use crate::candidate::{Candidate, TechniqueChoice, candidates};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::picture::create_folder;
use crate::trade::axes::Axes;
use crate::trade::held_out::Table;
use crate::trade::{Job, Trade};

/// What `trade` takes.
#[derive(clap::Args)]
pub struct Options {
    /// glTF or GLB files, or procedural scenes. What a scene's owner says of views and lights lies beside it: of garden.glb it is
    /// garden.views.json.
    #[arg(required = true)]
    scene: Vec<String>,
    /// A folder for the page, the results and the charts; it is made if need be. A run that was stopped goes on in it.
    #[arg(long)]
    out: PathBuf,
    /// What is compared.
    #[arg(long, value_enum, value_delimiter = ',', default_values = ["hard"])]
    jobs: Vec<Job>,
    /// Radii of the filter, in texels of the largest map. By default 2 and 6, with --quick 4.
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Vec<u32>,
    /// What else is varied.
    #[command(flatten)]
    varied: Varied,
}

/// What is varied besides the filter.
#[derive(Clone, Debug, clap::Args)]
pub struct Varied {
    /// One map, as many samples as it has at best, one filter and two views: within a minute.
    #[arg(long)]
    pub quick: bool,
    /// What the device offers.
    #[arg(long, value_parser = named(Profile::ALL, Profile::name), default_value = "native")]
    pub profile: Profile,
    /// Texels per side of the light's maps. By default 512 and 1024, with --quick 1024.
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(64..=4096))]
    pub map: Vec<u32>,
    /// Samples per texel of the light's map. By default 1 and 4, with --quick 4.
    #[arg(long, value_name = "N,...", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..=8))]
    pub samples: Vec<u32>,
    /// Techniques, each in all of its storages, in place of all.
    #[arg(long, num_args = 1.., value_name = "NAME|JSON")]
    pub technique: Vec<TechniqueChoice>,
    /// How many views are judged. By default 4, with --quick 2.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub views: Option<u32>,
    /// The number of the first view.
    #[arg(long, default_value_t = 0)]
    pub first_view: u32,
    /// Leaves out the ground plane, which otherwise touches the scene's lowest point.
    #[arg(long)]
    pub no_ground: bool,
}

impl Options {
    /// Runs the trade, and says where its page is.
    pub fn run(self) -> CommandResult {
        create_folder(&self.out)?;
        let radii = match (self.radius.is_empty(), self.varied.quick) {
            (false, _) => self.radius,
            (true, false) => vec![2, 6],
            (true, true) => vec![4],
        };
        let trade = self.varied.trade(self.scene, radii, self.jobs)?;
        let results = trade.run(&self.out)?;
        print!("{}", Table(&results));
        println!("{}", self.out.join("report.html").display());
        Ok(ExitCode::SUCCESS)
    }
}

impl Varied {
    /// The trade of scenes with these filters.
    pub fn trade(
        &self,
        scenes: Vec<String>,
        radii: Vec<u32>,
        jobs: Vec<Job>,
    ) -> Result<Trade, ValueError> {
        let given = |given: &[u32], full: &[u32], quick: &[u32]| match (given, self.quick) {
            ([], true) => quick.to_vec(),
            ([], false) => full.to_vec(),
            (given, _) => ascending(given),
        };
        let mut all = match self.technique.is_empty() {
            true => Candidate::all(),
            false => candidates(&self.technique, None)?,
        };
        all.retain(|candidate| Axes::offers(self.profile, candidate));
        Ok(Trade {
            scenes,
            axes: Axes {
                maps: given(&self.map, &[512, 1024], &[1024]),
                radii: ascending(&radii),
                samples: given(&self.samples, &[1, 4], &[4]),
                candidates: all,
            },
            profile: self.profile,
            picture: match self.quick {
                true => [320, 180],
                false => [640, 360],
            },
            views: [
                self.views.unwrap_or(if self.quick { 2 } else { 4 }),
                self.first_view,
            ],
            rounds: FEWEST_ROUNDS,
            stride: if self.quick { 8 } else { 4 },
            ground: !self.no_ground,
            jobs,
        })
    }
}

pub(super) fn ascending(values: &[u32]) -> Vec<u32> {
    let mut values = values.to_vec();
    values.sort_unstable();
    values.dedup();
    values
}
