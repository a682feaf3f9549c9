//! How the papers store moments: affine images that fill the range of normalised channels.
//!
//! Comparators for what the library does, and the evidence that the digits are right.

use core::array::from_fn;

use crate::dense::inverse;

/// An affine image of the power moments b_1, b_2, ...: channel i is sum_j matrix_ij b_j + offset_i.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantisation<const M: usize> {
    /// A row per channel, a column per moment.
    matrix: [[f64; M]; M],
    /// Added after the product.
    offset: [f64; M],
    /// The inverse of the matrix, row by row.
    pub inverse: [[f64; M]; M],
}

impl<const M: usize> Quantisation<M> {
    fn new(matrix: [[f64; M]; M], offset: [f64; M]) -> Self {
        Self {
            matrix,
            offset,
            inverse: inverse(matrix),
        }
    }

    /// The same with a number added to all channels.
    #[must_use]
    pub fn shifted(self, by: f64) -> Self {
        Self {
            offset: self.offset.map(|offset| offset + by),
            ..self
        }
    }

    /// The channels of moments.
    #[must_use]
    pub fn encode(&self, moments: &[f64; M]) -> [f64; M] {
        from_fn(|row| dot(&self.matrix[row], moments) + self.offset[row])
    }

    /// The moments of channels.
    #[must_use]
    pub fn decode(&self, channels: &[f64; M]) -> [f64; M] {
        let centred = from_fn(|row| channels[row] - self.offset[row]);
        self.inverse.map(|row| dot(&row, &centred))
    }

    /// The gradient with respect to the channels of a linear function of the moments.
    #[must_use]
    pub fn gradient(&self, of_moments: &[f64; M]) -> [f64; M] {
        from_fn(|channel| dot(&self.inverse.map(|row| row[channel]), of_moments))
    }
}

/// The power moments of a single depth.
#[must_use]
pub fn powers<const M: usize>(depth: f64) -> [f64; M] {
    from_fn(|index| depth.powi(index as i32 + 1))
}

fn dot<const M: usize>(one: &[f64; M], other: &[f64; M]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

/// Four moments of depths in [-1, 1] (Peters, GDC 2016; Peters et al., JCGT 6(1) 2017).
#[must_use]
pub fn four_moments() -> Quantisation<4> {
    let root = 3.0_f64.sqrt();
    Quantisation::new(
        [
            [1.5, 0.0, -2.0, 0.0],
            [0.0, 4.0, 0.0, -4.0],
            [0.5 * root, 0.0, -2.0 / 9.0 * root, 0.0],
            [0.0, 0.5, 0.0, 0.5],
        ],
        [0.5, 0.0, 0.5, 0.0],
    )
}

/// Four moments of depths in [0, 1] (Peters & Klein, i3D 2015, theta_4).
#[must_use]
pub fn four_moments_of_unit_depth() -> Quantisation<4> {
    Quantisation::new(
        [
            [-2.07224649, 32.23703778, -68.571074599, 39.3703274134],
            [13.7948857237, -59.4683975703, 82.0359750338, -35.364903257],
            [0.105877704, -1.9077466311, 9.3496555107, -6.6543490743],
            [9.7924062118, -33.7652110555, 47.9456096605, -23.9728048165],
        ],
        [0.035955884801, 0.0, 0.0, 0.0],
    )
}

/// Six moments of depths in [-1, 1] (Peters, GDC 2016).
#[must_use]
pub fn six_moments() -> Quantisation<6> {
    Quantisation::new(
        [
            [2.5, 0.0, -10.0, 0.0, 8.0, 0.0],
            [-1.8749986445, 0.0, 4.20757543111, 0.0, -1.83257678661, 0.0],
            [1.26583039016, 0.0, -1.47644882902, 0.0, 0.71061660238, 0.0],
            [0.0, 4.0, 0.0, -4.0, 0.0, 0.0],
            [0.0, 9.0, 0.0, -24.0, 0.0, 16.0],
            [0.0, -0.57759806484, 0.0, 4.61936647543, 0.0, -3.07953906655],
        ],
        [0.5, 0.5, 0.5, 0.0, 0.0, 0.018888946],
    )
}
