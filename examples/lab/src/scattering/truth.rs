//! Marched rays in double precision: the truth of single scattering.
//!
//! Nothing is shared with the library's shaders: positions are in world space, the light's own matrices say where they lie in its
//! map, and each step has the exact integral of the transmittance over it.

use glam::DVec3;
use moment_shadows::SingleScattering;
use rayon::prelude::*;

use crate::host::DepthSamples;
use crate::light::LightView;
use crate::truth::kernel::{AxisTaps, TapPattern};

/// View rays, and what they pass.
pub struct Rays<'a> {
    /// The camera.
    pub eye: DVec3,
    /// Vectors from the camera to where each ray ends.
    pub ends: &'a [DVec3],
    /// A directional light.
    pub light: &'a LightView,
    /// Its depth map, one sample per texel.
    pub depth: &'a DepthSamples,
    /// What is in the air.
    pub medium: &'a SingleScattering,
    /// Steps per ray.
    pub steps: u32,
}

/// In-scattered radiance of view rays, by colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MarchedRays {
    /// Radiance with the shadows of the map.
    pub radiance: Vec<[f32; 3]>,
    /// Radiance without any shadows.
    pub unshadowed: Vec<[f32; 3]>,
}

/// Rays through the plain map: a step is in shadow if its middle lies behind what the texel there holds.
#[must_use]
pub fn marched(rays: &Rays<'_>) -> MarchedRays {
    let map = Map::new(rays);
    map.march(|u, v, depth| {
        let texel = |place: f64, size: usize| ((place * size as f64) as usize).min(size - 1);
        let [x, y] = [texel(u, map.size[0]), texel(v, map.size[1])];
        f64::from(map.depth[y * map.size[0] + x] < depth)
    })
}

/// Rays through the filtered map: the share of texels under a kernel and a bilinear lookup that lie in front of a step's middle.
/// This is what filtering means, without anything that moments lose.
#[must_use]
pub fn marched_filtered(rays: &Rays<'_>, taps: &TapPattern, radius: u32) -> MarchedRays {
    let map = Map::new(rays);
    let reach = map.neighbourhoods(radius as usize);
    map.march(|u, v, depth| {
        // Most neighbourhoods are wholly in front or wholly behind.
        let left = |place: f64, size: usize| (place * size as f64 + 0.5).floor() as usize;
        let place = left(v, map.size[1]) * (map.size[0] + 1) + left(u, map.size[0]);
        let [nearest, farthest] = reach[place];
        if nearest >= depth {
            return 0.0;
        }
        if farthest < depth {
            return 1.0;
        }
        let [mut columns, mut rows] = [AxisTaps::default(), AxisTaps::default()];
        taps.along_axis(u, map.size[0] as u32, &mut columns);
        taps.along_axis(v, map.size[1] as u32, &mut rows);
        let mut shadow = 0.0;
        for (row, weight) in (rows.first..).zip(&rows.weights) {
            let first = row * map.size[0] + columns.first;
            let texels = &map.depth[first..first + columns.weights.len()];
            let behind = texels.iter().zip(&columns.weights);
            let behind: f64 = behind.map(|(it, w)| f64::from(*it < depth) * w).sum();
            shadow += weight * behind;
        }
        shadow
    })
}

/// The map in moment depth; texels without a caster are infinitely far away.
struct Map<'a> {
    rays: &'a Rays<'a>,
    size: [usize; 2],
    depth: Vec<f64>,
}

impl<'a> Map<'a> {
    fn new(rays: &'a Rays<'a>) -> Self {
        let depth = rays.depth.values.iter().map(|&stored| {
            let depth = rays.light.moment_depth_of_stored(f64::from(stored));
            if depth < 1.0 { depth } else { f64::INFINITY }
        });
        Self {
            rays,
            size: [rays.depth.width, rays.depth.height].map(|side| side as usize),
            depth: depth.collect(),
        }
    }

    /// Nearest and farthest depth under the kernel and a bilinear lookup between each two neighbouring columns and rows.
    fn neighbourhoods(&self, radius: usize) -> Vec<[f64; 2]> {
        let [width, height] = self.size;
        (0..(width + 1) * (height + 1))
            .into_par_iter()
            .map(|index| {
                let [x, y] = [index % (width + 1), index / (width + 1)];
                let range = |right: usize, size: usize| {
                    let low = right.saturating_sub(radius + 1).min(size - 1);
                    low..=(right + radius).min(size - 1)
                };
                let mut found = [f64::INFINITY, f64::NEG_INFINITY];
                for row in range(y, height) {
                    for column in range(x, width) {
                        let depth = self.depth[row * width + column];
                        found = [found[0].min(depth), found[1].max(depth)];
                    }
                }
                found
            })
            .collect()
    }

    /// Marches every ray; `shadow` is asked for places within the map and a moment depth.
    fn march(&self, shadow: impl Fn(f64, f64, f64) -> f64 + Sync) -> MarchedRays {
        let (light, medium) = (self.rays.light, self.rays.medium);
        let (eye, steps) = (self.rays.eye, self.rays.steps);
        // All three are linear along a ray.
        let place = |at: DVec3| {
            let uv = light.uv(at).unwrap_or_default();
            DVec3::new(uv.x, uv.y, light.moment_depth(at))
        };
        let start = place(eye);
        let light_direction = -light.towards_light(eye);
        let pixels: Vec<_> = (self.rays.ends.par_iter())
            .map(|&end| {
                let length = end.length();
                let change = place(eye + end) - start;
                let cosine = -end.dot(light_direction) / length.max(1e-300);
                let phase = phase(cosine, f64::from(medium.anisotropy));
                let extinction = medium.extinction.map(f64::from);
                let step = length / f64::from(steps);
                // Over one step, and from one to the next.
                let within = extinction.map(|it| integral(it, step));
                let through = extinction.map(|it| (-it * step).exp());
                let mut before = [1.0; 3];
                let mut sums = [[0.0; 3]; 2];
                for index in 0..steps {
                    let at = start + change * ((f64::from(index) + 0.5) / f64::from(steps));
                    let known = at.x >= 0.0 && at.x <= 1.0 && at.y >= 0.0 && at.y <= 1.0;
                    let lit = if known {
                        1.0 - shadow(at.x, at.y, at.z)
                    } else {
                        1.0
                    };
                    for colour in 0..3 {
                        let part = before[colour] * within[colour];
                        sums[0][colour] += lit * part;
                        sums[1][colour] += part;
                        before[colour] *= through[colour];
                    }
                }
                sums.map(|sum| {
                    [0, 1, 2].map(|colour| {
                        let scale = phase
                            * f64::from(medium.scattering[colour])
                            * f64::from(medium.irradiance[colour]);
                        (scale * sum[colour]) as f32
                    })
                })
            })
            .collect();
        MarchedRays {
            radiance: pixels.iter().map(|pixel| pixel[0]).collect(),
            unshadowed: pixels.iter().map(|pixel| pixel[1]).collect(),
        }
    }
}

/// The integral of exp(-extinction x) for x from 0 to a length.
fn integral(extinction: f64, length: f64) -> f64 {
    if extinction > 0.0 {
        -(-extinction * length).exp_m1() / extinction
    } else {
        length
    }
}

/// Henyey & Greenstein, 1941.
pub(super) fn phase(cosine: f64, g: f64) -> f64 {
    (1.0 - g * g) / (4.0 * core::f64::consts::PI * (1.0 + g * g - 2.0 * g * cosine).powf(1.5))
}
