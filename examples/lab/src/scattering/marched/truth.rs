//! Rays that are marched in double precision through the plain maps of all views of a light, in height fog.
//!
//! Nothing is shared with the library's shaders: positions are in the scene, and steps are equally long for every light. Over each of them
//! the transmittance and the falloff of the light are integrated exactly; its middle is in shadow or is not.

use glam::DVec3;
use moment_shadows::{MarchedAir, SingleScattering};
use rayon::prelude::*;

use super::lamp::Face;
use crate::host::DepthSamples;
use crate::scattering::truth::{MarchedRays, phase};

/// View rays, and what they pass.
pub(super) struct LampRays<'a> {
    pub(super) eye: DVec3,
    /// Vectors from the camera to where each ray ends.
    pub(super) ends: &'a [DVec3],
    /// The views of the light with their maps, one sample per texel.
    pub(super) faces: &'a [(Face, DepthSamples)],
    /// Where the light is, and within which radius it does not grow.
    pub(super) lamp: Option<(DVec3, f64)>,
    /// Where light travels to, and the spot's axis.
    pub(super) direction: DVec3,
    pub(super) medium: &'a SingleScattering,
    pub(super) air: &'a MarchedAir,
    pub(super) steps: u32,
}

impl LampRays<'_> {
    pub(super) fn march(&self) -> MarchedRays {
        let pixels: Vec<_> = (self.ends.par_iter()).map(|&end| self.ray(end)).collect();
        MarchedRays {
            radiance: pixels.iter().map(|pixel| pixel[0]).collect(),
            unshadowed: pixels.iter().map(|pixel| pixel[1]).collect(),
        }
    }

    fn ray(&self, end: DVec3) -> [[f32; 3]; 2] {
        let (medium, length) = (self.medium, end.length());
        let step = length / f64::from(self.steps);
        let along = end / length.max(1e-300);
        let mut before = [1.0; 3];
        let mut sums = [[0.0; 3]; 2];
        for index in 0..self.steps {
            let start = self.eye + f64::from(index) * step * along;
            let at = start + 0.5 * step * along;
            let thickness = self.thickness(start, along * step);
            let (light, irradiance, way) = self.light(at, along, step);
            let lit = f64::from(!self.is_shadowed(at));
            let phase = phase(-light.dot(along), f64::from(medium.anisotropy)) * irradiance;
            for colour in 0..3 {
                let [extinction, scattering, given] =
                    [medium.extinction, medium.scattering, medium.irradiance]
                        .map(|it| f64::from(it[colour]));
                let lost = extinction * thickness;
                let mean = if lost > 0.0 {
                    -(-lost).exp_m1() / lost
                } else {
                    1.0
                };
                let scattered = scattering * thickness * mean * (-extinction * way).exp();
                let part = before[colour] * phase * given * scattered;
                sums[0][colour] += lit * part;
                sums[1][colour] += part;
                before[colour] *= (-lost).exp();
            }
        }
        sums.map(|sum| sum.map(|colour| colour as f32))
    }

    /// The optical thickness per extinction of a stretch.
    fn thickness(&self, start: DVec3, stretch: DVec3) -> f64 {
        let fog = self.air.fog;
        let up = DVec3::from(fog.up);
        let density = (-fog.falloff * (up.dot(start) - fog.height)).exp();
        let fall = fog.falloff * up.dot(stretch);
        let mean = if fall.abs() > 1e-9 {
            -(-fall).exp_m1() / fall
        } else {
            1.0
        };
        density * mean * stretch.length()
    }

    /// Where light travels to at the middle of a step, its mean irradiance over the step, and what dims it on its way.
    fn light(&self, at: DVec3, along: DVec3, step: f64) -> (DVec3, f64, f64) {
        let Some((lamp, radius)) = self.lamp else {
            return (self.direction, 1.0, 0.0);
        };
        let away = at - lamp;
        let direction = away.normalize_or_zero();
        let middle = away.dot(along);
        let across = ((away - middle * along).length_squared() + radius * radius).sqrt();
        let angle = |end: f64| ((middle + end) / across).atan();
        let mut irradiance = (angle(0.5 * step) - angle(-0.5 * step)) / (across * step);
        if let Some(cone) = self.air.cone {
            let [inner, outer] = [cone.inner, cone.outer].map(|angle| (0.5 * angle).cos());
            let part = (direction.dot(self.direction) - outer) / (inner - outer);
            irradiance *= part.clamp(0.0, 1.0).powi(2);
        }
        (direction, irradiance, self.thickness(lamp, away))
    }

    /// Whether the first view that shows a point has something before it.
    fn is_shadowed(&self, at: DVec3) -> bool {
        for ((view, guard), map) in self.faces {
            let size = [map.width, map.height].map(f64::from);
            let Some(uv) = view.uv(at) else { continue };
            let place = [uv.x * size[0], uv.y * size[1]];
            let guard = f64::from(*guard);
            let is_within = |axis: usize| place[axis] >= guard && place[axis] <= size[axis] - guard;
            if !(is_within(0) && is_within(1)) {
                continue;
            }
            let [x, y] = [0, 1].map(|axis| place[axis].min(size[axis] - 1.0) as usize);
            let stored = f64::from(map.values[y * map.width as usize + x]);
            let caster = view.moment_depth_of_stored(stored);
            return caster < 1.0 && caster < view.moment_depth(at);
        }
        false
    }
}
