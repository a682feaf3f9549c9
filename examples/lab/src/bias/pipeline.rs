//! What a graph does to a patch: resolve, the blending of translucent casters and a Gaussian in two passes, every stage rounded to the
//! storage.

use super::casters::Caster;
use super::form::{Form, rounded};
use super::inwards::rounded_inwards;
use super::packed::packed;
use super::patch::{Patch, SIDE};
use crate::basis::powers;

/// The standard deviation of the Gaussian in texels (Peters & Klein, i3D 2015).
const DEVIATION: f64 = 2.4;

/// The Gaussian's weights along an axis, whose f32 sum is 1: the residue is in the centre.
pub(super) fn weights() -> [f32; SIDE] {
    let middle = SIDE / 2;
    let raw: [f64; SIDE] = core::array::from_fn(|tap| {
        let x = tap as f64 - middle as f64;
        (-0.5 * (x / DEVIATION).powi(2)).exp()
    });
    let total: f64 = raw.iter().sum();
    let mut weights = raw.map(|weight| (weight / total) as f32);
    let sum: f32 = weights.iter().sum();
    weights[middle] += 1.0 - sum;
    weights
}

/// The filtered moments after every texel, every caster that is blended over it, every row and the column have been rounded.
pub(super) fn three_roundings<const M: usize>(
    form: &Form<M>,
    patch: &Patch,
    casters: &[Caster],
    weights: &[f32; SIDE],
) -> [f64; M] {
    let store = |texel: [f32; M]| texel.map(|channel| rounded(form.storage, channel));
    let texel = |index: usize| {
        casters
            .iter()
            .fold(store(form.texel(patch[index])), |below, caster| {
                let (above, alpha) = (form.texel(caster.depths[index]), caster.alphas[index]);
                let channels = core::array::from_fn(|channel| {
                    alpha * above[channel] + (1.0 - alpha) * below[channel]
                });
                store(channels)
            })
    };
    filtered(form, weights, texel)
}

/// The filtered moments after every row and the column have been rounded, as a blur gives them that resolves.
pub(super) fn two_roundings<const M: usize>(
    form: &Form<M>,
    patch: &Patch,
    weights: &[f32; SIDE],
) -> [f64; M] {
    filtered(form, weights, |index| form.texel(patch[index]))
}

/// The filtered moments, rounded inwards, after rows were stored as packed texels of four moments: as a blur gives them that resolves.
/// None for a form without a basis.
pub(super) fn inwards<const M: usize>(
    form: &Form<M>,
    patch: &Patch,
    weights: &[f32; SIDE],
    alpha: f64,
) -> Option<[f64; M]> {
    let texel = |index: usize| {
        let z = patch[index];
        [z, z * z, z * z * z, z * z * (z * z)]
    };
    let column: [[f32; 4]; SIDE] = core::array::from_fn(|row| {
        let texels = core::array::from_fn(|tap| texel(SIDE * row + tap));
        packed(blend(&texels, weights))
    });
    let mean = blend(&column, weights);
    let moments = core::array::from_fn(|index| f64::from(mean[index]));
    rounded_inwards(form, alpha, &moments)
}

/// The moments of filtered texels: every row and the column are rounded.
fn filtered<const M: usize>(
    form: &Form<M>,
    weights: &[f32; SIDE],
    texel: impl Fn(usize) -> [f32; M],
) -> [f64; M] {
    let store = |texel: [f32; M]| texel.map(|channel| rounded(form.storage, channel));
    let mut column = [[0.0; M]; SIDE];
    for (row, filtered) in column.iter_mut().enumerate() {
        let texels: [[f32; M]; SIDE] = core::array::from_fn(|tap| texel(SIDE * row + tap));
        *filtered = store(blend(&texels, weights));
    }
    form.moments(store(blend(&column, weights)))
}

/// The exact filtered moments, rounded once.
pub(super) fn one_rounding<const M: usize>(
    form: &Form<M>,
    patch: &Patch,
    weights: &[f32; SIDE],
) -> [f64; M] {
    let mut sum = [0.0; M];
    let mut total = 0.0;
    for (texel, &depth) in patch.iter().enumerate() {
        let weight = f64::from(weights[texel % SIDE]) * f64::from(weights[texel / SIDE]);
        total += weight;
        let mut power = weight;
        for moment in &mut sum {
            power *= form.depth(depth);
            *moment += power;
        }
    }
    let moments = sum.map(|moment| moment / total);
    let channels = form
        .basis
        .as_ref()
        .map_or(moments, |basis| basis.encode(&moments));
    form.moments(channels.map(|channel| rounded(form.storage, channel as f32)))
}

/// A weighted sum in f32.
fn blend<const M: usize>(texels: &[[f32; M]; SIDE], weights: &[f32; SIDE]) -> [f32; M] {
    let mut sum = [0.0; M];
    for (texel, weight) in texels.iter().zip(weights) {
        for (sum, channel) in sum.iter_mut().zip(texel) {
            *sum += weight * channel;
        }
    }
    sum
}

impl<const M: usize> Form<M> {
    /// The form's depth of a moment depth in [-1, 1].
    fn depth(&self, depth: f32) -> f64 {
        let [low, high] = self.interval;
        low + 0.5 * (high - low) * (f64::from(depth) + 1.0)
    }

    /// The channels of one depth, before they are stored. Raw moments are powers in f32.
    fn texel(&self, depth: f32) -> [f32; M] {
        let z = self.depth(depth);
        match &self.basis {
            Some(basis) => basis.encode(&powers(z)).map(|value| value as f32),
            None => {
                let mut powers = [z as f32; M];
                for index in 1..M {
                    // Each power is the product of its two halves, as in the shader.
                    let half = index.div_ceil(2);
                    powers[index] = powers[half - 1] * powers[index - half];
                }
                powers
            }
        }
    }

    /// The moments of stored channels.
    fn moments(&self, channels: [f32; M]) -> [f64; M] {
        let channels = channels.map(f64::from);
        self.basis
            .as_ref()
            .map_or(channels, |basis| basis.decode(&channels))
    }
}
