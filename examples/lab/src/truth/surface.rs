//! What the truths are computed from: the surfaces in the picture and the unfiltered samples of the light's depth map.

use crate::host::{DepthSamples, SurfacePixels};
use crate::light::LightView;

use super::kernel::sample_positions;
use super::{check_length, check_map};
use crate::error::LabError;

/// Pixels of `surface`, if each of its lists has one entry for each.
pub(super) fn pixels(surface: &SurfacePixels) -> Result<usize, LabError> {
    let expected = surface.width as usize * surface.height as usize;
    for (what, found) in [
        ("the list of positions", surface.position.len()),
        ("the list of normals", surface.normal.len()),
        ("the list of covered pixels", surface.covered.len()),
    ] {
        check_length(what, found, expected)?;
    }
    Ok(expected)
}

/// How a depth texture rounds what it stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthRounding {
    /// `Depth32Float`.
    Float32,
    /// `Depth16Unorm`.
    Unorm16,
}

/// Every sample of an unfiltered depth map as moment depth.
#[derive(Clone, Debug, PartialEq)]
pub struct MomentDepths {
    size: [u32; 2],
    positions: Vec<[f64; 2]>,
    rounding: DepthRounding,
    /// By row, then sample, then column, so that the taps of a row are neighbours.
    moment_depth: Vec<f64>,
}

impl MomentDepths {
    /// Converts what the depth texture of `light` holds, in f64. NaN counts as the far end.
    pub fn from_stored(
        light: &LightView,
        stored: &DepthSamples,
        rounding: DepthRounding,
    ) -> Result<Self, LabError> {
        let size = [stored.width, stored.height];
        let samples = stored.samples;
        let stored = &stored.values;
        let [width, height] = size.map(|length| length as usize);
        check_map(size)?;
        let positions = sample_positions(samples).ok_or_else(|| {
            LabError::refused(format!(
                "a depth map of {samples} samples per texel has no standard pattern; use 1, 2, 4 or 8"
            ))
        })?;
        let count = positions.len();
        check_length(
            "the depth map",
            stored.len(),
            width.saturating_mul(height).saturating_mul(count),
        )?;
        let mut moment_depth = Vec::with_capacity(stored.len());
        for row in stored.chunks_exact(width * count) {
            for sample in 0..count {
                let of_sample = row.iter().skip(sample).step_by(count);
                moment_depth
                    .extend(of_sample.map(|&depth| light.moment_depth_of_stored(f64::from(depth))));
            }
        }
        Ok(Self {
            size,
            positions: positions.to_vec(),
            rounding,
            moment_depth,
        })
    }

    /// The samples of maps of `light` that were drawn one by one, each of `size` texels with its samples at one place within a
    /// texel. `draw` gives what a map stores, row by row, for such a place.
    pub fn from_maps(
        light: &LightView,
        size: [u32; 2],
        positions: &[[f64; 2]],
        mut draw: impl FnMut([f64; 2]) -> Result<Vec<f32>, LabError>,
    ) -> Result<Self, LabError> {
        check_map(size)?;
        let [width, height] = size.map(|length| length as usize);
        let mut moment_depth = vec![1.0; width * height * positions.len()];
        for (sample, &position) in positions.iter().enumerate() {
            let stored = draw(position)?;
            check_length("the depth map", stored.len(), width * height)?;
            for (y, row) in stored.chunks_exact(width).enumerate() {
                let start = (y * positions.len() + sample) * width;
                for (to, &depth) in moment_depth[start..].iter_mut().zip(row) {
                    *to = light.moment_depth_of_stored(f64::from(depth));
                }
            }
        }
        Ok(Self {
            size,
            positions: positions.to_vec(),
            rounding: DepthRounding::Float32,
            moment_depth,
        })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Where the samples of each texel lie.
    pub fn positions(&self) -> &[[f64; 2]] {
        &self.positions
    }

    /// How the texture rounded what it stored.
    pub fn rounding(&self) -> DepthRounding {
        self.rounding
    }

    /// Moment depth of sample `sample` of `count` texels of row `y` from column `first`; fewer at the border.
    pub fn row(&self, y: usize, sample: usize, first: usize, count: usize) -> &[f64] {
        let width = self.size[0] as usize;
        let start = (y * self.positions.len() + sample) * width;
        let row = self.moment_depth.get(start..start + width).unwrap_or(&[]);
        let end = first.saturating_add(count).min(row.len());
        row.get(first..end).unwrap_or(&[])
    }
}
