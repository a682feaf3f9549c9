//! The error of a technique over all surfaces that the light's rays meet (Peters and Klein, "Moment Shadow Mapping",
//! i3D 2015).
//!
//! A picture shows a few of the surfaces in a scene, from one side. This error knows no camera: it asks the technique for
//! the shadow intensity of every surface along every ray of the light and compares it with the truth. Exactly:
//!
//! - **Samples.** One ray through the centre of each texel of the light's map, and on it every surface
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

use moment_shadows::{LeakReduction, ReceiverBias, Storage};
use serde::Serialize;

pub use evaluate::{Evaluation, MapEvaluator, MapPoint};

use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::shade_parameters;
use crate::judgement::Unfiltered;
use crate::metric::{ErrorFigures, figures, signed_error};
use crate::scene::Scene;
use crate::truth::pcf::{Receiver, pcf_at};
use crate::truth::peel::{LightSurface, PeelError, Peeler};

/// Rays that are peeled at once: bounds the memory that surfaces take in full.
const RAYS_AT_ONCE: u32 = 1 << 16;

/// Edge-on surfaces have no gradient; above this their bias is limited anyway, and f32 can square it.
const LARGEST_GRADIENT: f64 = 1e15;

/// The surfaces along the rays of a light, and the truth of each under a kernel. Takes 28 bytes per surface.
pub struct SurfaceTruth {
    map: [u32; 2],
    rays: u64,
    caster_rays: u64,
    layers: u32,
    surfaces: Vec<Surface>,
}

/// What is kept of a surface.
struct Surface {
    texel: [u32; 2],
    moment_depth: f32,
    gradient: f32,
    /// Shadow intensity in front of its plane, and of its own depth.
    in_front_of_plane: f32,
    in_front_of_depth: f32,
    faces_light: bool,
    /// Whether its ray meets a caster.
    counts: bool,
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
    /// As a renderer shades: against the surface's plane.
    pub shading: ErrorFigures,
    /// The same over those that show the light their front: a renderer needs no map to know that the others are dark.
    pub shading_facing: ErrorFigures,
    /// The same over all surfaces of all rays, those that meet nothing but the ground among them.
    pub shading_all_rays: ErrorFigures,
    /// The moments alone: against the surface's own depth.
    pub distribution: ErrorFigures,
    /// Surfaces whose estimate is NaN. Each counts as an error of 1, too dark.
    pub nan: usize,
}

impl SurfaceTruth {
    /// Peels the scene of `frame` and computes the truths from its unfiltered map. Takes seconds; `step` is called
    /// [`steps`](Self::steps) times.
    pub fn of(
        scene: &Scene,
        frame: &Frame,
        unfiltered: &Unfiltered,
        step: impl Fn(),
    ) -> Result<Self, LabError> {
        let (light, map) = (&frame.desc.light, frame.desc.map);
        let peeler = Peeler::new(scene, light, map)?;
        let [near, far] = light.range;
        let per_distance = 2.0 / (far - near);
        let axis = light
            .view_from_world
            .inverse()
            .transform_vector3(glam::DVec3::Z);
        let mut truth = Self {
            map,
            rays: 0,
            caster_rays: 0,
            layers: 0,
            surfaces: Vec::new(),
        };
        for rows in (0..map[1]).step_by(rows_at_once(map)) {
            let found = peeler.rows(rows..rows.saturating_add(rows_at_once(map) as u32));
            let shadow = |normal: &dyn Fn(&LightSurface) -> glam::DVec3| {
                let receivers: Vec<Receiver> = found
                    .iter()
                    .map(|surface| Receiver {
                        position: surface.position,
                        normal: normal(surface),
                    })
                    .collect();
                pcf_at(light, &unfiltered.depths, &unfiltered.taps, &receivers)
            };
            let planes = shadow(&|surface| surface.normal);
            let depths = shadow(&|_| axis);
            let mut index = 0;
            for ray in found.chunk_by(|a, b| a.texel == b.texel) {
                let counts = ray.iter().any(|surface| !surface.ground);
                truth.rays += 1;
                truth.caster_rays += u64::from(counts);
                truth.layers = truth.layers.max(ray.len() as u32);
                for surface in ray {
                    let gradient =
                        (surface.distance_per_texel * per_distance).min(LARGEST_GRADIENT);
                    truth.surfaces.push(Surface {
                        texel: surface.texel,
                        moment_depth: light.moment_depth_of_distance(surface.distance) as f32,
                        gradient: gradient as f32,
                        in_front_of_plane: planes[index],
                        in_front_of_depth: depths[index],
                        faces_light: surface.faces_light,
                        counts,
                    });
                    index += 1;
                }
            }
            step();
        }
        if truth.caster_rays == 0 {
            return Err(PeelError::NoCaster {
                scene: scene.name.clone(),
                map,
            }
            .into());
        }
        Ok(truth)
    }

    /// How many steps [`of`](Self::of) takes for a map of `map` texels.
    pub fn steps(map: [u32; 2]) -> u64 {
        u64::from(map[1]).div_ceil(rows_at_once(map) as u64)
    }

    /// The error of a filtered map in `storage`, evaluated as `shading` says; the distribution's bound is taken with the
    /// same moment bias. All sums run over the surfaces in order, in f64: the same map gives the same figures.
    pub fn judge(
        &self,
        gpu: &Gpu,
        map: &wgpu::Texture,
        storage: Storage,
        shading: Evaluation,
    ) -> Result<SurfaceErrors, LabError> {
        let [width, height] = self.map.map(f64::from);
        let points: Vec<MapPoint> = self
            .surfaces
            .iter()
            .map(|surface| {
                let [x, y] = surface.texel.map(|at| f64::from(at) + 0.5);
                MapPoint {
                    uv: [(x / width) as f32, (y / height) as f32],
                    moment_depth: surface.moment_depth,
                    gradient: surface.gradient,
                }
            })
            .collect();
        let evaluator = MapEvaluator::new(gpu, map, storage)?;
        let shaded = evaluator.run(shading, &points)?;
        let bound = evaluator.run(
            Evaluation {
                receiver_bias: ReceiverBias::NONE,
                leak_reduction: LeakReduction::NONE,
                ..shading
            },
            &points,
        )?;
        let errors = |estimates: &[f32], truth: fn(&Surface) -> f32, of: fn(&Surface) -> bool| {
            let pairs = self.surfaces.iter().zip(estimates);
            let errors: Vec<f64> = pairs
                .filter(|(surface, _)| of(surface))
                .map(|(surface, &estimate)| signed_error(estimate, truth(surface)))
                .collect();
            figures(&errors)
        };
        let plane = |surface: &Surface| surface.in_front_of_plane;
        let depth = |surface: &Surface| surface.in_front_of_depth;
        let counted = self.surfaces.iter().zip(&shaded).zip(&bound);
        Ok(SurfaceErrors {
            rays: self.rays,
            caster_rays: self.caster_rays,
            peels: self.layers,
            shading: errors(&shaded, plane, |surface| surface.counts),
            shading_facing: errors(&shaded, plane, |surface| {
                surface.counts && surface.faces_light
            }),
            shading_all_rays: errors(&shaded, plane, |_| true),
            distribution: errors(&bound, depth, |surface| surface.counts),
            nan: counted
                .filter(|((_, shaded), bound)| shaded.is_nan() || bound.is_nan())
                .count(),
        })
    }
}

impl Evaluation {
    /// That of `shade_hard` in a graph on a frame.
    pub fn shading(frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let parameters = shade_parameters(&frame.desc, file)?;
        Ok(Self {
            receiver_bias: parameters.receiver_bias,
            leak_reduction: parameters.leak_reduction,
            moment_bias: None,
        })
    }
}

fn rows_at_once(map: [u32; 2]) -> usize {
    (RAYS_AT_ONCE / map[0].max(1)).max(1) as usize
}
