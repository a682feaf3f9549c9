//! The error of a technique over all surfaces that the light's rays meet (Peters and Klein, "Moment Shadow Mapping",
//! i3D 2015).
//!
//! A picture shows a few of the surfaces in a scene, from one side. This error knows no camera: it asks the technique for
//! the shadow intensity of every surface along every ray of the light and compares it with the truth. Exactly:
//!
//! - **Samples.** One ray through the centre of each texel of the light's map (or of one in a few), and on it every surface
//!   ([`truth::peel`](crate::truth::peel)), front and back sides alike, the ground too. Each counts as much as any other:
//!   they stand for the same area of the map. So the mean is over pairs of a texel and a surface on its ray. The mean error
//!   per texel is this mean times surfaces per ray. Rays that meet nothing but the ground are left out, unless said
//!   otherwise: they would dilute the mean by as much as there happens to be empty ground around a scene.
//! - **Estimate.** Made on the device by the functions that `shade_hard` calls, from the filtered map of the graph, at the
//!   texel's centre and on mip level 0: one ray stands for one texel.
//! - **Truth.** The share of samples of the *unfiltered* depth map of the device, under the same kernel and with all
//!   its samples per texel, that lie in front of the surface: [`pcf_at`].
//!
//! There are two readings of "in front of". Both are computed.
//!
//! - **Shading** ([`SurfaceErrors::shading`]): of the surface's plane at each sample, as a renderer wants it. The estimate
//!   is that of `shade_hard`: the fragment depth less the receiver bias for the plane's own slope, and after leak reduction.
//! - **Distribution** ([`SurfaceErrors::distribution`]): of the surface's own depth, so that the truth is the distribution
//!   of depth that the moments describe, and the estimate its lower bound without receiver bias and leak reduction. A slope
//!   shadows itself in both.
//!
//! These are severe scenes for a lower bound: the back of a bar lies within the leak's reach of its front, and so does the
//! ground under whatever stands on it. The paper reports 2.19 % for four moments in single precision under a 9 x 9 Gaussian of
//! standard deviation 2.4, on scenes of its own. Figures of one definition compare techniques on one scene; between scenes they
//! differ by far more than between techniques.

mod evaluate;
mod fitted;
mod judged_map;
mod map_point;
mod placed;

use std::sync::Arc;

use glam::DVec2;
use moment_shadows::{FourMomentsBias, LeakReduction, ReceiverBias};
use serde::Serialize;

pub use evaluate::{Evaluation, MapEvaluator};
pub use judged_map::{JudgedMap, MapRun};
pub use map_point::MapPoint;

use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::shade_parameters;
use crate::metric::{ErrorFigures, figures, signed_error};
use crate::scene::Scene;
use crate::truth::kernel::TapPattern;
use crate::truth::pcf::{Receiver, pcf_at};
use crate::truth::peel::{LightSurface, Peeler};
use crate::truth::surface::MomentDepths;

/// Rays that are peeled at once: bounds the memory that surfaces take in full.
const RAYS_AT_ONCE: u32 = 1 << 16;

/// The surfaces along the rays of a light. Takes 28 bytes per surface.
struct LitSurfaces {
    /// Texels of the map that rays were made for.
    map: [u32; 2],
    rays: u64,
    caster_rays: u64,
    layers: u32,
    points: Vec<MapPoint>,
    kinds: Vec<SurfaceKind>,
}

/// What of a surface decides which figures it counts for.
#[derive(Clone, Copy)]
struct SurfaceKind {
    faces_light: bool,
    /// Whether its ray meets a caster.
    counts: bool,
}

/// The surfaces along the rays of a light, and the truth of each under a kernel.
pub struct SurfaceTruth {
    lit: Arc<LitSurfaces>,
    /// Shadow intensity in front of the plane of each surface.
    in_front_of_plane: Vec<f32>,
    /// Shadow intensity in front of each surface's own depth.
    in_front_of_depth: Vec<f32>,
}

/// The error of a technique over all surfaces.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurfaceErrors {
    /// Rays that meet a surface.
    pub rays: u64,
    /// Rays that meet a caster: something else than the ground. All figures but `shading_all_rays` are over surfaces on
    /// these.
    pub caster_rays: u64,
    /// The most surfaces on one ray: how many peels it takes until nothing is left.
    pub peels: u32,
    /// Errors against the surface's plane, as a renderer shades.
    pub shading: ErrorFigures,
    /// Errors against the planes of surfaces that show the light their front: a renderer needs no map to know that the others
    /// are dark.
    pub shading_facing: ErrorFigures,
    /// Errors against the planes of all surfaces of all rays, including rays that meet nothing but the ground.
    pub shading_all_rays: ErrorFigures,
    /// Errors of the moments alone: against the surface's own depth.
    pub distribution: ErrorFigures,
    /// Surfaces whose estimate is NaN. Each counts as an error of 1, too dark.
    pub nan: usize,
}

impl LitSurfaces {
    /// The error of estimates over some of the surfaces, summed in their order.
    fn errors(
        &self,
        estimates: &[f32],
        truths: &[f32],
        of: fn(&SurfaceKind) -> bool,
    ) -> ErrorFigures {
        let pairs = self.kinds.iter().zip(estimates.iter().zip(truths));
        let errors = pairs.filter(|(kind, _)| of(kind));
        let errors = errors.map(|(_, (&estimate, &truth))| signed_error(estimate, truth));
        figures(errors.collect())
    }

    /// Adds what was peeled, row by row.
    fn add(&mut self, frame: &Frame, found: &[LightSurface]) {
        let light = &frame.desc.light;
        let size = DVec2::from_array(frame.desc.map.map(f64::from));
        let [near, far] = light.range;
        let per_distance = 2.0 / (far - near);
        for ray in found.chunk_by(|a, b| a.texel == b.texel) {
            let counts = ray.iter().any(|surface| !surface.ground);
            self.rays += 1;
            self.caster_rays += u64::from(counts);
            self.layers = self.layers.max(ray.len() as u32);
            for surface in ray {
                let place = DVec2::from_array(surface.texel.map(f64::from)) + 0.5;
                self.points.push(MapPoint::new(
                    place / size,
                    light.moment_depth_of_distance(surface.distance),
                    surface.distance_gradient * per_distance,
                ));
                self.kinds.push(SurfaceKind {
                    faces_light: surface.faces_light,
                    counts,
                });
            }
        }
    }
}

impl SurfaceTruth {
    /// Peels the scene of `frame` once and computes the truths under each of the `kernels` from its unfiltered map. Of the
    /// map's texels every `stride`-th along either axis has a ray. Takes seconds; `step` is called
    /// [`steps`](Self::steps) times.
    pub fn of(
        scene: &Scene,
        frame: &Frame,
        depths: &MomentDepths,
        kernels: &[TapPattern],
        stride: u32,
        step: impl Fn(),
    ) -> Result<Vec<Self>, LabError> {
        let (light, map) = (&frame.desc.light, frame.desc.map);
        let peeler = Peeler::new(scene, light, map)?;
        let axis = light
            .view_from_world
            .inverse()
            .transform_vector3(glam::DVec3::Z);
        let mut lit = LitSurfaces {
            map,
            rays: 0,
            caster_rays: 0,
            layers: 0,
            points: Vec::new(),
            kinds: Vec::new(),
        };
        let mut truths = vec![(Vec::new(), Vec::new()); kernels.len()];
        let stride = stride.max(1);
        for rows in (0..map[1]).step_by(rows_at_once(map)) {
            let mut found = peeler.rows(rows..rows.saturating_add(rows_at_once(map) as u32));
            found.retain(|surface| surface.texel.iter().all(|at| at % stride == 0));
            lit.add(frame, &found);
            let receivers = |normal: &dyn Fn(&LightSurface) -> glam::DVec3| -> Vec<Receiver> {
                found
                    .iter()
                    .map(|surface| Receiver {
                        position: surface.position,
                        normal: normal(surface),
                    })
                    .collect()
            };
            let planes = receivers(&|surface| surface.normal);
            let across = receivers(&|_| axis);
            for (taps, (in_front_of_plane, in_front_of_depth)) in kernels.iter().zip(&mut truths) {
                in_front_of_plane.extend(pcf_at(light, depths, taps, &planes));
                in_front_of_depth.extend(pcf_at(light, depths, taps, &across));
            }
            step();
        }
        if lit.caster_rays == 0 {
            return Err(LabError::refused(format!(
                "no ray of the light meets a caster of scene '{}' at the texels' centres of a map of {}x{}; use a larger map \
                 or another light",
                scene.name, map[0], map[1]
            )));
        }
        let lit = Arc::new(lit);
        let truths = truths.into_iter();
        Ok(truths
            .map(|(in_front_of_plane, in_front_of_depth)| Self {
                lit: Arc::clone(&lit),
                in_front_of_plane,
                in_front_of_depth,
            })
            .collect())
    }

    /// The error of shading with a map of `size` texels that the same light has drawn, larger or smaller than that of the truth: over
    /// all surfaces on rays that meet a caster, and over those of them that face the light.
    pub fn judge_size(
        &self,
        evaluator: &MapEvaluator<'_>,
        shading: Evaluation,
        size: [u32; 2],
    ) -> Result<[ErrorFigures; 2], LabError> {
        let lit = &self.lit;
        let scale = [0, 1].map(|axis| lit.map[axis] as f32 / size[axis] as f32);
        let scaled = lit.points.iter().map(|point| MapPoint {
            gradient: [0, 1].map(|axis| point.gradient[axis] * scale[axis]),
            ..*point
        });
        let shaded = evaluator.run(shading, &Vec::from_iter(scaled))?;
        let errors =
            |of: fn(&SurfaceKind) -> bool| lit.errors(&shaded, &self.in_front_of_plane, of);
        Ok([
            errors(|kind| kind.counts),
            errors(|kind| kind.counts && kind.faces_light),
        ])
    }

    /// How many steps [`of`](Self::of) takes for a map of `map` texels.
    pub fn steps(map: [u32; 2]) -> u64 {
        u64::from(map[1]).div_ceil(rows_at_once(map) as u64)
    }

    /// The error of a map, evaluated as `shading` says, and of four moments with another moment bias if one is given; the
    /// distribution's bound is taken with the same moment bias. All sums run over the surfaces in order, in f64: the same
    /// map gives the same figures.
    pub fn judge(
        &self,
        gpu: &Gpu,
        map: &JudgedMap<'_>,
        shading: Evaluation,
        moment_bias: Option<FourMomentsBias>,
    ) -> Result<SurfaceErrors, LabError> {
        let lit = &self.lit;
        let evaluator = MapEvaluator::new(gpu, map, moment_bias)?;
        let shaded = evaluator.run(shading, &lit.points)?;
        let bound = evaluator.run(
            Evaluation {
                receiver_bias: ReceiverBias::NONE,
                leak_reduction: LeakReduction::NONE,
                ..shading
            },
            &lit.points,
        )?;
        let (plane, depth) = (&self.in_front_of_plane, &self.in_front_of_depth);
        let estimates = shaded.iter().zip(&bound);
        Ok(SurfaceErrors {
            rays: lit.rays,
            caster_rays: lit.caster_rays,
            peels: lit.layers,
            shading: lit.errors(&shaded, plane, |kind| kind.counts),
            shading_facing: lit.errors(&shaded, plane, |kind| kind.counts && kind.faces_light),
            shading_all_rays: lit.errors(&shaded, plane, |_| true),
            distribution: lit.errors(&bound, depth, |kind| kind.counts),
            nan: estimates
                .filter(|(shaded, bound)| shaded.is_nan() || bound.is_nan())
                .count(),
        })
    }
}

impl Evaluation {
    /// The evaluation of `shade_hard` in a graph on a frame.
    pub fn shading(frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let parameters = shade_parameters(&frame.desc, file)?;
        Ok(Self {
            receiver_bias: parameters.receiver_bias,
            leak_reduction: parameters.leak_reduction,
            conversion: parameters.conversion,
            light: parameters.light,
            range: fitted::HOSTS_RANGE,
        })
    }
}

fn rows_at_once(map: [u32; 2]) -> usize {
    (RAYS_AT_ONCE / map[0].max(1)).max(1) as usize
}
