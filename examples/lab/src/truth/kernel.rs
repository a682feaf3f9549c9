//! The tap pattern that a filtered map applies at a point: its blur, the bilinear lookup and the samples of a texel.

use moment_shadows::Kernel;

/// The blur of a filtered map along one axis, the same along both: an odd number of weights that sum to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct TapPattern {
    weights: Vec<f64>,
}

/// What a filtered map applies along one axis at one coordinate: weights of neighbouring texels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct AxisTaps {
    /// The texel that the first weight belongs to.
    pub first: usize,
    /// Weights that sum to 1; at most `2 radius + 2`.
    pub weights: Vec<f64>,
}

impl TapPattern {
    /// The pattern of a map blurred with `kernel`. The weights are normalised once more, in f64.
    pub fn of_kernel(kernel: &Kernel) -> Self {
        Self::of_weights(kernel.weights().iter().copied().map(f64::from).collect())
    }

    /// The pattern of an odd number of weights with a sum above 0, which are normalised.
    pub fn of_weights(mut weights: Vec<f64>) -> Self {
        let sum: f64 = weights.iter().sum();
        for weight in &mut weights {
            *weight /= sum;
        }
        Self { weights }
    }

    /// The pattern of a map that is not blurred: the lookup alone.
    pub fn unblurred() -> Self {
        Self { weights: vec![1.0] }
    }

    /// The taps along one axis of a lookup at `coordinate` in a blurred map of `size` texels, filtered linearly: the
    /// blur convolved with the two weights of the lookup. Both repeat the last texel beyond the border, as
    /// clamp-to-edge does. `coordinate` runs from 0 to 1 across the map and is clamped to it; `size` is at least 1.
    pub fn along_axis(&self, coordinate: f64, size: u32, taps: &mut AxisTaps) {
        let last = i64::from(size.max(1)) - 1;
        let radius = (self.weights.len() / 2) as i64;
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

/// Positions of `count` samples inside a texel, spread so evenly that an edge of any direction divides them as it divides the texel:
/// each axis has them all at different places (Hammersley's points).
#[must_use]
pub fn even_positions(count: u32) -> Vec<[f64; 2]> {
    let share = |index: u32| (f64::from(index) + 0.5) / f64::from(count.max(1));
    let bits = count.max(2).next_power_of_two().trailing_zeros();
    let mirrored = |index: u32| {
        let reversed = index.reverse_bits() >> (32 - bits);
        (f64::from(reversed) + 0.5) / f64::from(1_u32 << bits)
    };
    (0..count)
        .map(|index| [share(index), mirrored(index)])
        .collect()
}
