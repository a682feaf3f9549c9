//! Area lights: the mean of the hard shadows of many places on a light, in f64 on the processor.
//!
//! For each place, a shadow map would be drawn and tested without a filter. Here the ray from the receiver to the place is
//! tested against the scene's triangles themselves, which is the limit of ever larger maps, without a texel or a bias.
//! All rays of a receiver lie in one pyramid; each triangle in it hides the places within its shadow on the light, which
//! three edge functions tell. Two triangles with a common edge leave no gap between them. Masked materials have their
//! holes.
//!
//! Shadow intensity is the share of hidden places among those that the receiver's surface faces.

mod bvh;
mod samples;
mod shaft;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::bvh::Bvh;
use self::shaft::{Affine, Shade, Shaft, Target};
use super::opacity::{AlphaCorners, Opacity};
use super::peel::{check, position};
use super::surface::pixels;
use crate::error::LabError;
use crate::host::SurfacePixels;
use crate::light::{LightKind, LightShape, LightView};
use crate::scene::Scene;

/// Places per light where nothing else is said.
pub const USUAL_PLACES: u32 = 256;

/// The most places on a light.
pub const MOST_PLACES: u32 = 1 << 16;

/// By which part of the scene's size rays start off their surface, towards its normal's side: above what positions of a
/// G-buffer are rounded by, 2^-24 of the coordinates a few times, and below what a picture shows.
const OFFSET: f64 = 1e-5;

/// A scene under an area light.
pub struct AreaLight<'a> {
    light: &'a LightView,
    /// Position of a light that has one.
    position: Option<DVec3>,
    right: DVec3,
    up: DVec3,
    /// The vector against the light's axis, unit.
    axis: DVec3,
    half: DVec2,
    places: Vec<DVec2>,
    casters: Vec<Caster>,
    bvh: Bvh,
    /// Opacity of each material.
    opacity: Vec<Option<Opacity>>,
    /// Half the diagonal of the scene without its ground.
    radius: f64,
}

struct Caster {
    corners: [DVec3; 3],
    normal: DVec3,
    holes: Option<Holes>,
}

/// A triangle of a masked material.
struct Holes {
    material: usize,
    corners: AlphaCorners,
}

/// Lists that are reused from pixel to pixel.
#[derive(Default)]
struct Scratch {
    stack: Vec<u32>,
    /// A bit per place that is hidden, or behind the receiver's horizon.
    hidden: Vec<u64>,
}

impl<'a> AreaLight<'a> {
    /// Prepares a scene: `light` is the centre of a light of this shape, with `count` places, 1 to [`MOST_PLACES`].
    pub fn new(
        scene: &Scene,
        light: &'a LightView,
        shape: LightShape,
        count: u32,
    ) -> Result<Self, LabError> {
        shape.check(light.kind())?;
        if !(1..=MOST_PLACES).contains(&count) {
            return Err(LabError::refused(format!(
                "an area light is sampled at 1 to {MOST_PLACES} places, not at {count}"
            )));
        }
        let opacity: Vec<Option<Opacity>> = scene
            .materials
            .iter()
            .map(|material| Opacity::of(material, &scene.images))
            .collect();
        let mut casters = Vec::new();
        for (index, mesh) in scene.meshes.iter().enumerate() {
            check(scene, index, mesh)?;
            let masked = (scene.materials.get(mesh.material)).is_some_and(|it| it.mask.is_some());
            for &indices in mesh.indices.as_chunks::<3>().0 {
                let corners = indices.map(|corner| position(mesh, corner));
                let [a, b, c] = corners;
                casters.push(Caster {
                    corners,
                    normal: (b - a).cross(c - a),
                    holes: masked.then(|| Holes {
                        material: mesh.material,
                        corners: AlphaCorners::of(mesh, indices),
                    }),
                });
            }
        }
        let world_from_view = light.view_from_world.inverse();
        let [right, up, axis] =
            [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| world_from_view.transform_vector3(axis));
        let corners: Vec<[DVec3; 3]> = casters.iter().map(|caster| caster.corners).collect();
        Ok(Self {
            light,
            position: (light.kind() == LightKind::Spot)
                .then(|| world_from_view.transform_point3(DVec3::ZERO)),
            right,
            up,
            axis,
            half: 0.5 * DVec2::from_array(shape.extent()),
            places: samples::places(shape, count),
            bvh: Bvh::new(&corners),
            casters,
            opacity,
            radius: scene.bounds().radius(),
        })
    }

    /// The shadow intensity of each pixel of a G-buffer; 0 where nothing is seen, and behind a light with a position. The same
    /// input gives the same bits on any number of threads.
    pub fn picture(&self, surface: &SurfacePixels) -> Result<Vec<f32>, LabError> {
        let vector = |value: [f32; 3]| DVec3::from(value.map(f64::from));
        Ok((0..pixels(surface)?)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, pixel| {
                if !surface.covered[pixel] {
                    return 0.0;
                }
                let position = vector(surface.position[pixel]);
                let normal = vector(surface.normal[pixel]).normalize_or_zero();
                self.intensity_with(position, normal, scratch) as f32
            })
            .collect())
    }

    /// The shadow intensity of a point of a surface with a unit normal: the share of hidden places among those in front of
    /// it; 1 if no place is in front of it.
    #[must_use]
    pub fn intensity(&self, position: DVec3, normal: DVec3) -> f64 {
        self.intensity_with(position, normal, &mut Scratch::default())
    }

    fn intensity_with(&self, position: DVec3, normal: DVec3, scratch: &mut Scratch) -> f64 {
        let size = self.radius + position.abs().max_element();
        let origin = position + OFFSET * size * normal;
        let base = match self.position {
            Some(_) if self.light.distance(origin) <= 0.0 => return 0.0,
            Some(position) => position - origin,
            None => self.axis,
        };
        let target = Target {
            base,
            right: self.right,
            up: self.up,
            half: self.half,
            finite: self.position.is_some(),
        };
        let Scratch { stack, hidden } = scratch;
        let faced = self.begin(Affine::new(normal, &target), hidden);
        if faced == 0 {
            return 1.0;
        }
        let shaft = Shaft::new(origin, target, self.axis);
        let mut open = faced;
        self.bvh.search(
            stack,
            |bounds| shaft.meets(bounds),
            |item| {
                let caster = &self.casters[item as usize];
                if let Some(shade) = shaft.shade(&caster.corners, caster.normal) {
                    open -= self.hide(caster, &shade, hidden);
                }
                open == 0
            },
        );
        f64::from(faced - open) / f64::from(faced)
    }

    /// Marks the places behind the horizon as hidden; gives how many are not.
    fn begin(&self, horizon: Affine, hidden: &mut Vec<u64>) -> u32 {
        hidden.clear();
        let mut faced = 0;
        for places in self.places.chunks(64) {
            // The bits beyond the last place count as hidden, too.
            let mut word = u64::MAX;
            for (bit, &place) in places.iter().enumerate() {
                word ^= u64::from(horizon.at(place) > 0.0) << bit;
            }
            faced += word.count_zeros();
            hidden.push(word);
        }
        faced
    }

    /// Marks what a triangle hides; gives how many places it is the first to hide.
    fn hide(&self, caster: &Caster, shade: &Shade, hidden: &mut [u64]) -> u32 {
        let mut first = 0;
        for (places, hidden) in self.places.chunks(64).zip(hidden) {
            if *hidden == u64::MAX {
                continue;
            }
            let mut word = 0;
            if shade.complete {
                word = u64::MAX;
            } else {
                for (bit, &place) in places.iter().enumerate() {
                    // No branches: four products and sums for several places at a time.
                    let least = shade.bounds.map(|bound| bound.at(place));
                    let least = least[0].min(least[1]).min(least[2].min(least[3]));
                    word |= u64::from(least >= 0.0) << bit;
                }
            }
            word &= !*hidden;
            if let Some(holes) = &caster.holes {
                for (bit, &place) in places.iter().enumerate() {
                    if word >> bit & 1 == 1 && self.is_hole(holes, shade, place) {
                        word ^= 1 << bit;
                    }
                }
            }
            first += word.count_ones();
            *hidden |= word;
        }
        first
    }

    fn is_hole(&self, holes: &Holes, shade: &Shade, place: DVec2) -> bool {
        let Some(Some(opacity)) = self.opacity.get(holes.material) else {
            return false;
        };
        let [a, b, c, _] = shade.bounds.map(|bound| bound.at(place));
        let weights = DVec3::new(a, b, c) / (a + b + c);
        opacity.is_hole(&holes.corners, weights)
    }
}
