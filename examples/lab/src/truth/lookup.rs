//! What a filtered map combines where a pixel looks it up.

use rayon::prelude::*;

use super::kernel::{AxisTaps, TapPattern};
use super::surface::MomentDepths;

/// What the shader asks of the filtered map at one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lookup {
    /// Where it looks the map up.
    pub uv: [f64; 2],
    /// The fragment's moment depth, from which the receiver bias has been taken.
    pub fragment_depth: f64,
}

/// What `evaluate` makes of the samples that the filtered map combines at each lookup, of their weights, which sum to 1, and of the
/// fragment depth; 0 where there is no lookup.
pub fn at_each(
    depths: &MomentDepths,
    taps: &TapPattern,
    lookups: &[Option<Lookup>],
    evaluate: impl Fn(&[f64], &[f64], f64) -> f64 + Sync,
) -> Vec<f32> {
    lookups
        .par_iter()
        .map_init(Scratch::default, |scratch, lookup| {
            lookup.map_or(0.0, |lookup| {
                scratch.gather(depths, taps, lookup.uv);
                evaluate(&scratch.samples, &scratch.weights, lookup.fragment_depth) as f32
            })
        })
        .collect()
}

/// The samples that the filtered map combines at `uv`, and their weights, which sum to 1.
#[must_use]
pub fn under(depths: &MomentDepths, taps: &TapPattern, uv: [f64; 2]) -> [Vec<f64>; 2] {
    let mut scratch = Scratch::default();
    scratch.gather(depths, taps, uv);
    [scratch.samples, scratch.weights]
}

/// Lists that are reused from pixel to pixel.
#[derive(Default)]
struct Scratch {
    columns: AxisTaps,
    rows: AxisTaps,
    samples: Vec<f64>,
    weights: Vec<f64>,
}

impl Scratch {
    /// Collects all samples that the filtered map combines at `uv`.
    fn gather(&mut self, depths: &MomentDepths, taps: &TapPattern, uv: [f64; 2]) {
        let [width, height] = depths.size();
        taps.along_axis(uv[0], width, &mut self.columns);
        taps.along_axis(uv[1], height, &mut self.rows);
        let samples = depths.positions().len();
        self.samples.clear();
        self.weights.clear();
        for (y, row_weight) in self.rows.weights.iter().enumerate() {
            let share = row_weight / samples as f64;
            for sample in 0..samples {
                let row = depths.row(
                    self.rows.first + y,
                    sample,
                    self.columns.first,
                    self.columns.weights.len(),
                );
                self.samples.extend_from_slice(row);
                self.weights
                    .extend(self.columns.weights.iter().map(|weight| share * weight));
            }
        }
    }
}
