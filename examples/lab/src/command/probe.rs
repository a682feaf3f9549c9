//! `moment-shadows-lab probe`: what a scene asks of its shadows.

use core::fmt;

use moment_shadows::Profile;
use serde::Serialize;

use super::trade::Varied;
use super::{CommandResult, print};
use crate::trade::Job;
use crate::trade::probe::ViewProbe;

/// What `probe` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A glTF or GLB file, or a procedural scene.
    scene: String,
    /// Radii of the filter, in texels of the largest map.
    #[arg(long, value_name = "N,...", value_delimiter = ',', default_values = ["2", "6"], value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Vec<u32>,
    /// Smaller pictures and two views.
    #[arg(long)]
    quick: bool,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=4096))]
    map: u32,
    /// How many views are looked at. By default 4, with --quick 2. Scenes with a file of views have those.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    views: Option<u32>,
    /// The number of the first view.
    #[arg(long, default_value_t = 0)]
    first_view: u32,
    /// Leaves out the ground plane, which otherwise touches the scene's lowest point.
    #[arg(long)]
    no_ground: bool,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// What views of a scene ask for.
#[derive(Serialize)]
struct Report {
    scene: String,
    /// Texels per side of the light's map.
    map: u32,
    /// Radii of the filter, in its texels.
    radii: Vec<u32>,
    views: Vec<ViewProbe>,
}

impl Options {
    /// Prints what all views ask for.
    pub fn run(self) -> CommandResult {
        let scenes = vec![self.scene.clone()];
        let varied = Varied {
            quick: self.quick,
            profile: Profile::WebgpuCore,
            map: vec![self.map],
            samples: Vec::new(),
            technique: Vec::new(),
            views: self.views,
            first_view: self.first_view,
            no_ground: self.no_ground,
        };
        let trade = varied.trade(scenes, self.radius, vec![Job::Hard])?;
        let report = Report {
            views: trade.probe(&self.scene)?,
            scene: self.scene,
            map: trade.axes.largest_map(),
            radii: trade.axes.radii.clone(),
        };
        print(&report, self.json)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}, map {}x{}", self.scene, self.map, self.map)?;
        let percent = |share: f64| format!("{:.1} %", 100.0 * share);
        for probe in &self.views {
            let [near, far] = probe.depth_used;
            let [low, middle, high] = probe.texels_per_pixel;
            writeln!(
                f,
                "\nview {}: uses {} of the light's range (moment depth {near:.3} to {far:.3}); a pixel is {middle:.2} texels wide \
                 (5 %: {low:.2}, 95 %: {high:.2}); {} of what faces the light is beside its map",
                probe.view,
                percent(0.5 * (far - near)),
                percent(probe.outside)
            )?;
            for (radius, shares) in self.radii.iter().zip(&probe.surfaces) {
                let [one, two, three, more] = shares.map(percent);
                writeln!(
                    f,
                    "  filtered by {radius} texels, pixels meet one surface: {one}, two: {two}, three: {three}, more: {more}"
                )?;
            }
            for sentence in probe.needs(&self.radii) {
                writeln!(f, "  {sentence}")?;
            }
        }
        Ok(())
    }
}
