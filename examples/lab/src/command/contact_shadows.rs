//! `moment-shadows-lab contact-shadows`: light at contacts with a march through the camera's depth and without.

use moment_shadows::{ContactShadows, Profile};

use super::trade::Varied;
use super::{CommandResult, print};
use crate::candidate::TechniqueChoice;
use crate::contact_shadows::ContactTrial;
use crate::progress;
use crate::scene::{CHAIRS, PROCEDURAL};
use crate::trade::Job;

/// What `contact-shadows` takes.
#[derive(clap::Args)]
pub struct Options {
    /// glTF or GLB files, or procedural scenes. Leaks are judged on chairs alone, whose feet are known.
    #[arg(default_values = [CHAIRS, PROCEDURAL[0], PROCEDURAL[1]])]
    scene: Vec<String>,
    /// How far the march goes, in scene units.
    #[arg(long, default_value_t = ContactShadows::default().length)]
    length: f64,
    /// How thick surfaces are, in scene units.
    #[arg(long, default_value_t = ContactShadows::default().thickness)]
    thickness: f64,
    /// The most steps of the march.
    #[arg(long, default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=64))]
    steps: u32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=4096))]
    map: u32,
    /// The radius of the filter, in texels.
    #[arg(long, default_value_t = 4, value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: u32,
    /// Techniques, each in all of its storages.
    #[arg(long, num_args = 1.., value_name = "NAME|JSON", default_value = "hamburger4")]
    technique: Vec<TechniqueChoice>,
    /// Pictures of half the size, and two views.
    #[arg(long)]
    quick: bool,
    /// How many views are judged. By default 4, with --quick 2.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    views: Option<u32>,
    /// The number of the first view.
    #[arg(long, default_value_t = 0)]
    first_view: u32,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Judges, and prints a table.
    pub fn run(self) -> CommandResult {
        let contact = ContactShadows {
            length: self.length,
            thickness: self.thickness,
        };
        contact.check()?;
        let varied = Varied {
            quick: self.quick,
            profile: Profile::NativeAdapter,
            map: vec![self.map],
            samples: vec![4],
            technique: self.technique,
            views: self.views,
            first_view: self.first_view,
            no_ground: false,
        };
        let mut trade = varied.trade(self.scene, vec![self.radius], vec![Job::Hard])?;
        // A pixel of the smaller pictures of a trade is as wide as a third of the band around a leg.
        trade.picture = trade.picture.map(|side| 2 * side);
        let steps = trade.scenes.len() * trade.axes.cells().len();
        let bar = progress::bar(steps as u64, "marching");
        let trial = ContactTrial {
            trade,
            contact,
            steps: self.steps,
        };
        let report = trial.run(|| bar.inc(1))?;
        bar.finish_and_clear();
        print(&report, self.json)
    }
}
