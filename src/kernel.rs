//! Filter kernels: weights along one direction of a separable filter.

use serde::{Deserialize, Serialize};

use crate::ValueError;
use crate::constants::PERCENTAGE_CLOSER_LARGEST_RADIUS;

/// Weights are multiples of this, 2^-18, for the sums of the WGSL module `split_sum`.
const WEIGHT_UNIT: f64 = 1.0 / (1 << 18) as f64;

/// The variance in texels that a map has without a kernel: a texel is the mean of its square, and a bilinear lookup averages two of
/// them, by 1/6 on average.
const VARIANCE_OF_TEXELS: f64 = 1.0 / 12.0 + 1.0 / 6.0;

/// Weights of 2 radius + 1 texels along one direction: not negative, multiples of 2^-18 that sum to exactly 1.
///
/// Only filters with such weights keep moments valid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Kernel {
    weights: Vec<f32>,
}

impl Kernel {
    /// The largest radius of a kernel, in texels.
    pub const LARGEST_RADIUS: u32 = PERCENTAGE_CLOSER_LARGEST_RADIUS as u32;

    /// A Gaussian of standard deviation `sigma` texels, cut off at `radius` texels.
    pub fn gaussian(radius: u32, sigma: f32) -> Result<Self, ValueError> {
        let largest = Self::LARGEST_RADIUS;
        if radius == 0 || radius > largest {
            let message = format!("a kernel's radius is 1 to {largest} texels, not {radius}");
            return Err(ValueError::new("radius", message));
        }
        if !(sigma.is_finite() && sigma > 0.0) {
            let message = format!("a Gaussian's sigma is a positive number of texels, not {sigma}");
            return Err(ValueError::new("sigma", message));
        }
        let radius = i64::from(radius);
        let weights: Vec<f64> = (-radius..=radius)
            .map(|offset| {
                let ratio = offset as f64 / f64::from(sigma);
                (-0.5 * ratio * ratio).exp()
            })
            .collect();
        Ok(Self::normalised(&weights))
    }

    /// The kernel by which shadows in a map are filtered over a width in scene units, whatever the size of its texels: `width` is
    /// the standard deviation of the whole filter in texels, of which the lookup is a part. Below half a texel it is that of the
    /// lookup alone. The radius is two standard deviations, rounded up.
    ///
    /// # Errors
    /// [`ValueError`] about the `width`, where it is negative, no number, or the radius would be above `largest`.
    pub fn of_width(width: f64, largest: u32) -> Result<Self, ValueError> {
        let deviation = Self::deviation_of_width(width);
        let variance = deviation * deviation;
        let radius = (2.0 * deviation).ceil().max(1.0);
        let largest = largest.min(Self::LARGEST_RADIUS);
        if !(width >= 0.0 && radius <= f64::from(largest)) {
            let message = format!(
                "a filter of a standard deviation of {width} texels; a kernel of radius {largest} has at most {}",
                (f64::from(largest * largest) / 4.0 + VARIANCE_OF_TEXELS).sqrt()
            );
            return Err(ValueError::new("width", message));
        }
        let radius = radius as usize;
        // Weights are q^(k k), half of them: from products alone, so that every machine has the same. Their variance grows with q,
        // from 0 to that of a box, which is above the one that is asked for.
        let half = |q: f64| {
            let mut step = q;
            let mut weights = [1.0; Self::LARGEST_RADIUS as usize + 1];
            for offset in 0..radius {
                weights[offset + 1] = weights[offset] * step;
                step *= q * q;
            }
            weights
        };
        let variance_of = |half: &[f64]| {
            let (mut sum, mut squares) = (1.0, 0.0);
            for (offset, weight) in half.iter().enumerate().take(radius + 1).skip(1) {
                sum += 2.0 * weight;
                squares += 2.0 * weight * (offset * offset) as f64;
            }
            squares / sum
        };
        let (mut low, mut high) = (0.0, 1.0);
        // Weights are rounded to 2^-18.
        for _ in 0..32 {
            let middle = 0.5 * (low + high);
            if variance_of(&half(middle)) < variance {
                low = middle;
            } else {
                high = middle;
            }
        }
        let half = &half(low)[..=radius];
        let whole = half.iter().skip(1).rev().chain(half).copied();
        Ok(Self::normalised(&whole.collect::<Vec<_>>()))
    }

    /// The standard deviation of the kernel of a filter of that width ([`of_width`](Self::of_width)), both in texels.
    #[must_use]
    pub fn deviation_of_width(width: f64) -> f64 {
        (width * width - VARIANCE_OF_TEXELS).max(0.0).sqrt()
    }

    /// Given weights, normalised. Their number is odd, 3 to 129; the middle one belongs to the texel itself.
    pub fn from_weights(weights: &[f32]) -> Result<Self, ValueError> {
        let of_weights = |message| ValueError::new("weights", message);
        let largest = 2 * Self::LARGEST_RADIUS as usize + 1;
        if weights.len().is_multiple_of(2) || weights.len() < 3 || weights.len() > largest {
            let count = weights.len();
            return Err(of_weights(format!(
                "a kernel has an odd number of weights, 3 to {largest}, not {count}"
            )));
        }
        if let Some((index, &value)) = weights
            .iter()
            .enumerate()
            .find(|(_, weight)| !weight.is_finite() || **weight < 0.0)
        {
            return Err(of_weights(format!(
                "weight {index} is {value}; a filter of moments needs finite weights that are not negative"
            )));
        }
        if weights.iter().all(|&weight| weight == 0.0) {
            let message = "all weights are 0; at least one must be positive";
            return Err(of_weights(message.to_owned()));
        }
        let weights: Vec<f64> = weights.iter().map(|&weight| f64::from(weight)).collect();
        Ok(Self::normalised(&weights))
    }

    /// The texels on either side of the centre.
    #[must_use]
    pub fn radius(&self) -> u32 {
        (self.weights.len() / 2) as u32
    }

    /// The weights, from the texel with the lowest coordinate.
    #[must_use]
    pub fn weights(&self) -> &[f32] {
        &self.weights
    }

    /// The kernel's standard deviation in texels: smaller than the sigma of a Gaussian, which the radius cuts off.
    #[must_use]
    pub fn standard_deviation(&self) -> f32 {
        let mean_of = |value: &dyn Fn(f64) -> f64| -> f64 {
            let weights = self.weights.iter().enumerate();
            let weighted = weights.map(|(index, &weight)| value(index as f64) * f64::from(weight));
            weighted.sum()
        };
        let mean = mean_of(&|position| position);
        let variance = mean_of(&|position| (position - mean).powi(2));
        variance.max(0.0).sqrt() as f32
    }

    /// Scales to a sum of 1 and rounds to multiples of [`WEIGHT_UNIT`] that sum to exactly 1: a sum that is off by one unit
    /// acts like an error of that size in every moment. The partial sums are rounded, so that no weight gets all of the
    /// residue.
    fn normalised(weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        let mut sum = 0.0;
        let mut units_so_far = 0.0;
        let weights = weights
            .iter()
            .map(|weight| {
                sum += weight;
                let units = (sum / total / WEIGHT_UNIT).round();
                let weight = (units - units_so_far) * WEIGHT_UNIT;
                units_so_far = units;
                // A whole number of units, at most 2^18: exact in f32.
                weight as f32
            })
            .collect();
        Self { weights }
    }
}
