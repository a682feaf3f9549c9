//! What the truths are computed from: the surfaces in the picture and the unfiltered samples of the light's depth map.

use crate::host::{DepthSamples, SurfacePixels};
use crate::light::LightView;

use super::kernel::sample_positions;

/// Why no truth can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// A list does not have one entry per pixel or sample.
    #[error("{what} has {found} entries where its size asks for {expected}")]
    Length {
        /// What the list holds.
        what: &'static str,
        /// How many entries it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// Only the standard sample patterns have known positions.
    #[error("a depth map of {samples} samples per texel has no standard pattern; use 1, 2, 4 or 8")]
    Samples {
        /// The sample count.
        samples: u32,
    },
    /// There is no texel to look up.
    #[error("a depth map of {}x{} texels is empty", size[0], size[1])]
    Empty {
        /// Width and height in texels.
        size: [u32; 2],
    },
}

/// Pixels of `surface`, if each of its lists has one entry for each.
pub(super) fn pixels(surface: &SurfacePixels) -> Result<usize, TruthError> {
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
    positions: &'static [[f64; 2]],
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
    ) -> Result<Self, TruthError> {
        let size = [stored.width, stored.height];
        let samples = stored.samples;
        let stored = &stored.values;
        let [width, height] = size.map(|length| length as usize);
        if width == 0 || height == 0 {
            return Err(TruthError::Empty { size });
        }
        let positions = sample_positions(samples).ok_or(TruthError::Samples { samples })?;
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
            positions,
            rounding,
            moment_depth,
        })
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// Where the samples of each texel lie.
    pub fn positions(&self) -> &'static [[f64; 2]] {
        self.positions
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

/// Refuses a list that has not one entry for each pixel or sample.
fn check_length(what: &'static str, found: usize, expected: usize) -> Result<(), TruthError> {
    if found == expected {
        Ok(())
    } else {
        Err(TruthError::Length {
            what,
            found,
            expected,
        })
    }
}
