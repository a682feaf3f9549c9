//! What a scene asks of its shadows, seen from one view: how many surfaces a filter meets, how much of the light's range is used, and how
//! the map's texels compare with pixels.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::frame::FrameDesc;
use crate::graph_frame::light_view;
use crate::host::SurfacePixels;
use crate::truth::kernel::TapPattern;
use crate::truth::lookup::{Lookup, at_each};
use crate::truth::surface::MomentDepths;

/// One pixel in so many is looked at; a prime, so that they fall on all columns.
const STRIDE: usize = 7;

/// Surfaces that are as far apart in depth as so many texels are wide are different ones; a slope of 75 degrees still is one.
const APART: f64 = 4.0;

/// A surface counts from this share of the filter on: less than that shadows nobody sees.
const LEAST_SHARE: f64 = 0.01;

/// What one view asks for. Shares are of pixels that face the light and lie in its map.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct ViewProbe {
    /// The number of the view.
    pub view: u32,
    /// The nearest and the farthest moment depth of what casts or receives shadows, within [-1, 1].
    pub depth_used: [f64; 2],
    /// For each softness the shares of pixels whose filter meets one, two, three and more surfaces.
    pub surfaces: Vec<[f64; 4]>,
    /// Texels of the largest map along a pixel: 5 % of pixels have fewer, half of them, and 95 %.
    pub texels_per_pixel: [f64; 3],
    /// The share of all pixels that face the light and lie beside its map, where nothing casts a shadow.
    pub outside: f64,
}

impl ViewProbe {
    /// The probe of a drawn view, with a filter for each softness.
    pub(super) fn of(
        view: u32,
        desc: &FrameDesc,
        depths: &MomentDepths,
        kernels: &[TapPattern],
        pixels: &SurfacePixels,
        facing: &[bool],
    ) -> Self {
        let light = &desc.light;
        let position = |pixel: usize| DVec3::from_array(pixels.position[pixel].map(f64::from));
        let (mut lookups, mut outside, mut used) = (Vec::new(), 0, [1.0_f64, -1.0_f64]);
        let mut widths = Vec::new();
        let mut count = 0;
        let map = f64::from(desc.map[0]);
        for pixel in (0..facing.len())
            .step_by(STRIDE)
            .filter(|&pixel| facing[pixel])
        {
            count += 1;
            let uv = light.uv(position(pixel));
            let inside = |at: f64| (0.0..=1.0).contains(&at);
            let Some(uv) = uv.filter(|uv| inside(uv.x) && inside(uv.y)) else {
                outside += 1;
                continue;
            };
            let depth = light.moment_depth(position(pixel)).clamp(-1.0, 1.0);
            used = [used[0].min(depth), used[1].max(depth)];
            lookups.push(Some(Lookup {
                uv: uv.to_array(),
                fragment_depth: depth,
            }));
            // The neighbour to the right, if there is one on a surface.
            let next = pixel + 1;
            let beside = next % pixels.width as usize != 0 && facing.get(next) == Some(&true);
            if let Some(other) = beside.then(|| light.uv(position(next))).flatten() {
                widths.push((other - uv).length() * map);
            }
        }
        for y in 0..desc.map[1] as usize {
            let row = depths.row(y, 0, 0, desc.map[0] as usize);
            for &depth in row.iter().filter(|&&depth| depth < 1.0) {
                used = [used[0].min(depth), used[1].max(depth)];
            }
        }
        let apart = APART * light_view(desc).depth_per_texel(desc.map);
        let of_kernel = |taps: &TapPattern| {
            let counts = at_each(depths, taps, &lookups, |samples, weights, _| {
                surfaces(samples, weights, apart) as f64
            });
            let share = |surfaces: usize| {
                let is_so = |count: &&f32| (**count as usize).clamp(1, 4) == surfaces;
                counts.iter().filter(is_so).count() as f64 / counts.len().max(1) as f64
            };
            [1, 2, 3, 4].map(share)
        };
        widths.sort_by(f64::total_cmp);
        let quantile = |share: f64| {
            let at = (share * widths.len() as f64) as usize;
            widths.get(at).copied().unwrap_or(0.0)
        };
        Self {
            view,
            depth_used: used,
            surfaces: kernels.iter().map(of_kernel).collect(),
            texels_per_pixel: [0.05, 0.5, 0.95].map(quantile),
            outside: f64::from(outside) / f64::from(count.max(1)),
        }
    }
}

impl ViewProbe {
    /// What the figures mean for a choice, a sentence each.
    #[must_use]
    pub fn needs(&self, radii: &[u32]) -> Vec<String> {
        let mut needs = Vec::new();
        for (radius, [_, two, three, more]) in radii.iter().zip(&self.surfaces) {
            let of = if *radius == 1 {
                "1 texel".to_owned()
            } else {
                format!("{radius} texels")
            };
            // Whatever knows n surfaces reproduces a receiver and n - 1 occluders.
            needs.push(match (two + three + more, three + more, *more) {
                (several, ..) if several < RARE => {
                    format!("With a filter of {of} nothing casts a shadow that a filter could blend: a binary test does.")
                }
                (_, several, _) if several < RARE => {
                    format!("With a filter of {of} two moments suffice: more than an occluder and a receiver are rare.")
                }
                (.., several) if several < RARE => {
                    format!("With a filter of {of} four moments leak at {:.0} % of pixels, six do not.", 100.0 * three)
                }
                (_, several, _) => format!(
                    "With a filter of {of} four moments may leak at {:.0} % of pixels, six at {:.0} %.",
                    100.0 * several,
                    100.0 * more
                ),
            });
        }
        let [near, far] = self.depth_used;
        let used = 0.5 * (far - near);
        if used > 0.0 && used < 0.5 {
            needs.push(format!(
                "{:.0} % of the light's range is waste: without it leaks would reach {:.1} times less far.",
                100.0 * (1.0 - used),
                1.0 / used
            ));
        }
        let [_, middle, _] = self.texels_per_pixel;
        if middle > 2.0 {
            needs.push(format!(
                "The map is finer than the picture by {middle:.1}: one of {:.1} times fewer texels along each side shows as much, or mip levels keep it from flickering.",
                middle
            ));
        } else if middle > 0.0 && middle < 0.5 {
            needs.push(format!(
                "The picture is finer than the map by {:.1}: a larger map shows more.",
                1.0 / middle
            ));
        }
        needs
    }
}

/// What happens at a smaller share of pixels is rare.
const RARE: f64 = 0.01;

/// How many surfaces there are among samples: groups of depths without a gap that is at least `apart`.
fn surfaces(samples: &[f64], weights: &[f64], apart: f64) -> usize {
    let mut sorted: Vec<(f64, f64)> = samples
        .iter()
        .copied()
        .zip(weights.iter().copied())
        .collect();
    sorted.sort_by(|one, other| one.0.total_cmp(&other.0));
    let groups = sorted.chunk_by(|one, other| other.0 - one.0 < apart);
    let counts = |group: &&[(f64, f64)]| {
        let share: f64 = group.iter().map(|(_, weight)| weight).sum();
        share >= LEAST_SHARE
    };
    groups.filter(counts).count()
}

#[cfg(test)]
mod tests {
    use super::surfaces;

    #[test]
    fn groups_of_depth_with_a_weight_are_surfaces() {
        let weights = [0.3, 0.3, 0.395, 0.005];
        assert_eq!(surfaces(&[0.0, 0.01, 0.02, 0.9], &weights, 0.05), 1);
        assert_eq!(surfaces(&[0.0, 0.5, 0.02, 0.9], &weights, 0.05), 2);
        assert_eq!(surfaces(&[0.0, 0.5, 0.8, 0.9], &weights, 0.05), 3);
        assert_eq!(surfaces(&[0.0, 0.5, 0.8, 0.9], &weights, 1.0), 1);
    }
}
