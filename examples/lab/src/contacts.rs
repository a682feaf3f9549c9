//! Light leaking where thin legs meet the ground, of a graph against the truth.

use glam::{DVec2, DVec3};
use moment_shadows::Technique;

use crate::command::render::RenderOptions;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::judgement::Unfiltered;
use crate::scene::{self, CHAIRS, Scene, feet};
use crate::surface_error::{MapEvaluator, MapPoint, MapRun};
use crate::truth::pcf::{Receiver, pcf_at};

/// How far from a leg the ground counts, in metres.
pub const BAND: f64 = 0.03;

/// Points along either side of the square around a foot.
pub(crate) const POINTS: u32 = 64;

/// Ground that is darker than this, of 1, is in full shadow.
pub(crate) const FULL: f32 = 0.99;

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

/// What a technique gives of them: mean shadow intensities.
#[derive(Clone, Debug, PartialEq)]
pub struct ContactErrors {
    /// What was shaded with.
    pub technique: Technique,
    /// Mean of the truth.
    pub truth: f64,
    /// Mean of what is too light.
    pub leaking: f64,
    /// Points in full shadow.
    pub points_in_full_shadow: usize,
    /// The mean leak over them.
    pub leaking_in_full_shadow: f64,
}

impl Contacts {
    /// Draws the scene of chairs and computes the truth around their legs for the kernel of a graph.
    pub fn new(gpu: &Gpu, options: &RenderOptions, file: &GraphFile) -> Result<Self, LabError> {
        let scene = scene::load(CHAIRS)?;
        let margin = file.radius()?;
        let frame = options.frame(gpu, &scene, &options.drawn(file)?, margin)?;
        let unfiltered = Unfiltered::of(gpu, &frame, file)?;
        let light = &frame.desc.light;
        let receivers = ground_around_legs(&scene).receivers;
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
        Ok(ContactErrors::of(map.technique(), &shaded, &self.truth))
    }
}

impl ContactErrors {
    /// Those of shadow intensities around legs.
    pub(crate) fn of(technique: Technique, shaded: &[f32], truth: &[f32]) -> Self {
        let mean = |values: &[f32]| {
            values.iter().copied().map(f64::from).sum::<f64>() / values.len().max(1) as f64
        };
        let leaks = |least: f32| -> Vec<f32> {
            let pairs = shaded.iter().zip(truth);
            let pairs = pairs.filter(|(_, truth)| **truth > least);
            pairs
                .map(|(shaded, truth)| (truth - shaded).max(0.0))
                .collect()
        };
        let in_full_shadow = leaks(FULL);
        Self {
            technique,
            truth: mean(truth),
            leaking: mean(&leaks(f32::NEG_INFINITY)),
            points_in_full_shadow: in_full_shadow.len(),
            leaking_in_full_shadow: mean(&in_full_shadow),
        }
    }
}

/// Points on the ground around all legs, in a column of squares of [`POINTS`] by [`POINTS`], one for each leg.
pub(crate) struct Ground {
    pub(crate) receivers: Vec<Receiver>,
    /// The number of each point in the column, row by row.
    pub(crate) places: Vec<usize>,
}

/// A grid of points on the ground around every leg, from its farthest corner to [`BAND`] beyond.
pub(crate) fn ground_around_legs(scene: &Scene) -> Ground {
    let (mut receivers, mut places) = (Vec::new(), Vec::new());
    for (number, foot) in (0..).zip(feet(scene)) {
        let reach = foot.radius + BAND;
        let at = |index: u32| reach * (2.0 * (f64::from(index) + 0.5) / f64::from(POINTS) - 1.0);
        for z in 0..POINTS {
            for x in 0..POINTS {
                let offset = DVec2::new(at(x), at(z));
                let distance = offset.length();
                if distance > foot.radius && distance <= reach {
                    places.push(((number * POINTS + z) * POINTS + x) as usize);
                    receivers.push(Receiver {
                        position: foot.centre + DVec3::new(offset.x, 0.0, offset.y),
                        normal: DVec3::Y,
                    });
                }
            }
        }
    }
    Ground { receivers, places }
}
