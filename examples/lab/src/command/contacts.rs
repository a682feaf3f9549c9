//! `moment-shadows contacts`: light leaking where thin legs meet the ground, of every technique against the truth.

use core::fmt;
use std::path::PathBuf;

use glam::{DVec2, DVec3};
use moment_shadows::{Storage, Technique};
use serde::Serialize;

use super::error::{Setting, storage_name};
use super::render::{RenderOptions, profile_for};
use super::{CommandResult, print};
use crate::candidate::{TechniqueChoice, candidates};
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::judgement::Unfiltered;
use crate::progress;
use crate::scene::{self, CHAIRS, Scene, feet};
use crate::surface_error::{MapEvaluator, MapPoint, MapRun};
use crate::techniques::described;
use crate::truth::pcf::{Receiver, pcf_at};

/// What `contacts` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    frame: RenderOptions,
    /// The graph file.
    #[arg(long)]
    graph: PathBuf,
    /// Radii of the Gaussian, in texels.
    #[arg(long, num_args = 1.., default_values = ["1", "4", "12"], value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Vec<u32>,
    /// Techniques in place of all: names with usual settings, or objects as in graph files.
    #[arg(long, num_args = 1..)]
    technique: Vec<TechniqueChoice>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// How far from a leg the ground counts, in metres.
pub const BAND: f64 = 0.03;

/// Points along either side of the square around a foot.
const POINTS: u32 = 64;

/// Ground that is darker than this, of 1, is in full shadow.
const FULL: f32 = 0.99;

/// The ground around all legs, with its true shadow intensity under a kernel.
pub struct Contacts {
    /// The scene as drawn.
    pub frame: Frame,
    /// The points, where the light's map is looked up.
    pub points: Vec<MapPoint>,
    /// Shadow intensity at each point.
    pub truth: Vec<f32>,
    /// What the truth was computed from.
    pub unfiltered: Unfiltered,
}

/// What a technique gives of them. Means are over all points of the band, unless it is said otherwise.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactErrors {
    /// Radius of the Gaussian, in texels.
    pub radius: u32,
    /// What was shaded with.
    pub technique: Technique,
    /// The storage of the filtered map; none where the plain depth map is read.
    pub storage: Option<Storage>,
    /// Bits per texel of the map, all planes.
    pub bits_per_texel: u32,
    /// Points of the band.
    pub points: usize,
    /// Mean shadow intensity of the truth.
    pub truth: f64,
    /// Mean of what is too light.
    pub leaking: f64,
    /// Mean of what is too dark.
    pub overdarkening: f64,
    /// Points in full shadow.
    pub points_in_full_shadow: usize,
    /// The mean leak over them.
    pub leaking_in_full_shadow: f64,
}

/// What `moment-shadows contacts` prints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ContactTable {
    /// How it was measured.
    pub setting: Setting,
    /// Radius by radius, in the order of the candidates.
    pub rows: Vec<ContactErrors>,
}

impl Contacts {
    /// Draws the scene of chairs and computes the truth around their legs for the kernel of a graph.
    pub fn new(gpu: &Gpu, options: &RenderOptions, file: &GraphFile) -> Result<Self, LabError> {
        let scene = scene::load(CHAIRS)?;
        let margin = file.kernel()?.map_or(0, |kernel| kernel.radius());
        let frame = options.frame(gpu, &scene, margin)?;
        let unfiltered = Unfiltered::of(gpu, &frame, file)?;
        let light = &frame.desc.light;
        let receivers = ground_around_legs(&scene);
        let truth = pcf_at(light, &unfiltered.depths, &unfiltered.taps, &receivers);
        let points = receivers
            .iter()
            .map(|receiver| MapPoint::of_plane(light, frame.desc.map, receiver))
            .collect();
        Ok(Self {
            points,
            truth,
            unfiltered,
            frame,
        })
    }

    /// Runs a graph with their kernel on a frame of their light and judges what it gives.
    pub fn judge(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        file: &GraphFile,
    ) -> Result<ContactErrors, LabError> {
        let run = MapRun::new(gpu, frame, file)?;
        let map = run.map(frame)?;
        let shaded = MapEvaluator::new(gpu, &map, None)?.run(run.shading, &self.points)?;
        let points = self.truth.len();
        let over = |errors: &mut dyn Iterator<Item = f32>, count: usize| {
            errors.map(f64::from).sum::<f64>() / count.max(1) as f64
        };
        let pairs = || shaded.iter().zip(&self.truth);
        let in_full_shadow = || pairs().filter(|(_, truth)| **truth > FULL);
        let full = in_full_shadow().count();
        let leak = |(shaded, truth): (&f32, &f32)| (truth - shaded).max(0.0);
        Ok(ContactErrors {
            radius: file.kernel()?.map_or(0, |kernel| kernel.radius()),
            technique: map.technique(),
            storage: map.storage(),
            bits_per_texel: map.bits_per_texel(),
            points,
            truth: over(&mut self.truth.iter().copied(), points),
            leaking: over(&mut pairs().map(leak), points),
            overdarkening: over(
                &mut pairs().map(|(shaded, truth)| (shaded - truth).max(0.0)),
                points,
            ),
            points_in_full_shadow: full,
            leaking_in_full_shadow: over(&mut in_full_shadow().map(leak), full),
        })
    }
}

/// A grid of points on the ground around every leg, from its farthest corner to [`BAND`] beyond.
fn ground_around_legs(scene: &Scene) -> Vec<Receiver> {
    let mut receivers = Vec::new();
    for foot in feet(scene) {
        let reach = foot.radius + BAND;
        let at = |index: u32| reach * (2.0 * (f64::from(index) + 0.5) / f64::from(POINTS) - 1.0);
        for z in 0..POINTS {
            for x in 0..POINTS {
                let offset = DVec2::new(at(x), at(z));
                let distance = offset.length();
                if distance > foot.radius && distance <= reach {
                    receivers.push(Receiver {
                        position: foot.centre + DVec3::new(offset.x, 0.0, offset.y),
                        normal: DVec3::Y,
                    });
                }
            }
        }
    }
    receivers
}

impl Options {
    /// Prints the table.
    pub fn run(self) -> CommandResult {
        print(&self.measure()?, self.json)
    }

    /// Measures every radius with every candidate.
    fn measure(&self) -> Result<ContactTable, LabError> {
        let options = &self.frame;
        let candidates = candidates(&self.technique, None)?;
        let profile = profile_for(None, options.samples);
        let profile = candidates.iter().fold(profile, |profile, candidate| {
            candidate.profile_with(profile)
        });
        let gpu = Gpu::open(profile)?;
        let file = GraphFile::read(&self.graph, None)?;
        let bar = progress::bar((self.radius.len() * candidates.len()) as u64, "contacts");
        let plainly = RenderOptions {
            samples: 1,
            ..options.clone()
        };
        let mut rows = Vec::new();
        for &radius in &self.radius {
            let file = file.with_radius(radius)?;
            let contacts = Contacts::new(&gpu, options, &file)?;
            let plain = plainly.frame(&gpu, &scene::load(CHAIRS)?, radius)?;
            for candidate in &candidates {
                let frame = if candidate.reads_depth() {
                    &plain
                } else {
                    &contacts.frame
                };
                rows.push(contacts.judge(&gpu, frame, &candidate.graph(&file)?)?);
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        Ok(ContactTable {
            setting: Setting::of(&gpu, &self.graph, options),
            rows,
        })
    }
}

impl fmt::Display for ContactTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.setting)?;
        writeln!(
            f,
            "Shadow intensity of the ground within {} cm of chair legs in percent: truth, what is too light and too dark, the \
             share of the shadow that leaks, and the leak where the truth is full shadow.\n",
            100.0 * BAND
        )?;
        writeln!(
            f,
            "| radius | technique | storage | bits | points | truth | leaking | too dark | share | leaking in full shadow |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|---|---|---|")?;
        for row in &self.rows {
            write!(
                f,
                "| {} | {} | {} | {} | {} |",
                row.radius,
                described(&row.technique),
                storage_name(row.storage),
                row.bits_per_texel,
                row.points
            )?;
            for figure in [
                row.truth,
                row.leaking,
                row.overdarkening,
                row.leaking / row.truth.max(f64::MIN_POSITIVE),
                row.leaking_in_full_shadow,
            ] {
                write!(f, " {:.3} |", 100.0 * figure)?;
            }
            writeln!(f)?;
        }
        Ok(())
    }
}
