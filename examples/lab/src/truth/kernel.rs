//! The tap pattern that a filtered map applies at a point: its blur, the bilinear lookup and the samples of a texel.

/// Why weights make no filter kernel.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum KernelError {
    /// There is no centre.
    #[error("a kernel of {count} weights has no centre; give an odd number of weights")]
    Even {
        /// How many weights were given.
        count: usize,
    },
    /// Moments stay valid only under convex combinations.
    #[error("weight {index} of the kernel is {value}; weights must be finite and not negative")]
    Weight {
        /// Which weight it is.
        index: usize,
        /// The weight.
        value: f64,
    },
    /// Nothing is left to normalise.
    #[error("the kernel's weights sum to {sum}; the sum must be finite and above zero")]
    Sum {
        /// The sum.
        sum: f64,
    },
}

/// One direction of a separable blur: `2 radius + 1` non-negative weights that sum to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Kernel {
    weights: Vec<f64>,
}

/// What a filtered map applies along one axis at one coordinate: weights of neighbouring texels, first texel first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisTaps {
    /// The texel that the first weight belongs to.
    pub first: usize,
    /// Weights that sum to 1; at most `2 radius + 2`.
    pub weights: Vec<f64>,
}

impl Kernel {
    /// A kernel of the given weights, which are normalised.
    pub fn new(weights: &[f64]) -> Result<Self, KernelError> {
        if weights.len().is_multiple_of(2) {
            return Err(KernelError::Even {
                count: weights.len(),
            });
        }
        for (index, &value) in weights.iter().enumerate() {
            if !(value.is_finite() && value >= 0.0) {
                return Err(KernelError::Weight { index, value });
            }
        }
        let sum: f64 = weights.iter().sum();
        if !(sum > 0.0 && sum.is_finite()) {
            return Err(KernelError::Sum { sum });
        }
        Ok(Self {
            weights: weights.iter().map(|weight| weight / sum).collect(),
        })
    }

    /// A Gaussian of standard deviation `sigma` texels, cut off beyond `radius` texels.
    pub fn gaussian(radius: u32, sigma: f64) -> Result<Self, KernelError> {
        let reach = i64::from(radius);
        let weights: Vec<f64> = (-reach..=reach)
            .map(|offset| (-0.5 * (offset as f64 / sigma).powi(2)).exp())
            .collect();
        Self::new(&weights)
    }

    /// How many texels the kernel reaches to either side.
    pub fn radius(&self) -> usize {
        self.weights.len() / 2
    }

    /// The weights, which sum to 1; the middle one belongs to the texel itself.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Variance of the offset under the weights, about their mean, in square texels.
    pub fn variance(&self) -> f64 {
        let radius = self.radius() as f64;
        let offsets = || {
            self.weights
                .iter()
                .enumerate()
                .map(|(i, w)| (i as f64 - radius, w))
        };
        let mean: f64 = offsets().map(|(offset, weight)| weight * offset).sum();
        offsets()
            .map(|(offset, weight)| weight * (offset - mean).powi(2))
            .sum()
    }

    /// The taps along one axis of a lookup at `coordinate` in a blurred map of `size` texels, filtered linearly: the
    /// blur convolved with the two weights of the lookup. Both repeat the last texel beyond the border, as
    /// clamp-to-edge does. `coordinate` runs from 0 to 1 across the map and is clamped to it; `size` is at least 1.
    pub fn axis_taps(&self, coordinate: f64, size: u32, taps: &mut AxisTaps) {
        let last = i64::from(size.max(1)) - 1;
        let radius = self.radius() as i64;
        // Texel centres lie at half-integers.
        let position = coordinate.clamp(0.0, 1.0) * f64::from(size) - 0.5;
        let left = position.floor();
        let fraction = position - left;
        let blurred = [left as i64, left as i64 + 1].map(|texel| texel.clamp(0, last));
        let first = (blurred[0] - radius).clamp(0, last);
        let end = (blurred[1] + radius).clamp(0, last);
        taps.first = first as usize;
        taps.weights.clear();
        taps.weights.resize((end - first + 1) as usize, 0.0);
        for (centre, share) in blurred.into_iter().zip([1.0 - fraction, fraction]) {
            for (index, weight) in self.weights.iter().enumerate() {
                let texel = (centre + index as i64 - radius).clamp(0, last);
                taps.weights[(texel - first) as usize] += share * weight;
            }
        }
    }
}

/// Positions of the samples inside a texel, as fractions of it from its top left corner: the standard sample locations
/// of Vulkan and Direct3D, which every sample of a resolve weighs alike. `None` for counts other than 1, 2, 4 and 8.
pub fn sample_positions(samples: u32) -> Option<&'static [[f64; 2]]> {
    match samples {
        1 => Some(&[[0.5, 0.5]]),
        2 => Some(&[[0.75, 0.75], [0.25, 0.25]]),
        4 => Some(&[
            [0.375, 0.125],
            [0.875, 0.375],
            [0.125, 0.625],
            [0.625, 0.875],
        ]),
        8 => Some(&[
            [0.5625, 0.3125],
            [0.4375, 0.6875],
            [0.8125, 0.5625],
            [0.3125, 0.1875],
            [0.1875, 0.8125],
            [0.0625, 0.4375],
            [0.6875, 0.9375],
            [0.9375, 0.0625],
        ]),
        _ => None,
    }
}
