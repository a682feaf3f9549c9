//! How the papers store moments: affine images that fill the range of normalised channels.
//!
//! Comparators for what the library does, and the evidence that the digits are right.

use crate::dense::Factors;

/// An affine image of power moments: channel i is sum_j matrix_ij b_j + offset_i.
#[derive(Clone, Debug, PartialEq)]
pub struct Quantisation {
    /// A short name.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// The least and the greatest depth.
    pub interval: [f64; 2],
    /// A row per channel, a column per moment.
    pub matrix: Vec<Vec<f64>>,
    /// Added after the product.
    pub offset: Vec<f64>,
    /// The inverse of the matrix, row by row.
    pub inverse: Vec<Vec<f64>>,
    /// By how much channels may leave [0, 1] for depths in the interval, given the published digits.
    pub overshoot: f64,
}

impl Quantisation {
    /// The number of moments.
    #[must_use]
    pub fn count(&self) -> usize {
        self.offset.len()
    }

    /// The channels of b_1, b_2, ...
    #[must_use]
    pub fn encode(&self, moments: &[f64]) -> Vec<f64> {
        product(&self.matrix, moments)
            .into_iter()
            .zip(&self.offset)
            .map(|(value, offset)| value + offset)
            .collect()
    }

    /// The moments of channels.
    #[must_use]
    pub fn decode(&self, channels: &[f64]) -> Vec<f64> {
        let centred: Vec<f64> = channels
            .iter()
            .zip(&self.offset)
            .map(|(value, offset)| value - offset)
            .collect();
        product(&self.inverse, &centred)
    }

    /// The moments of a single depth.
    #[must_use]
    pub fn powers(&self, depth: f64) -> Vec<f64> {
        (1..=self.count())
            .map(|power| depth.powi(power as i32))
            .collect()
    }

    /// The least and the greatest value of each channel over `steps` + 1 depths of the interval.
    #[must_use]
    pub fn image(&self, steps: u32) -> Vec<[f64; 2]> {
        let mut image = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.count()];
        let [low, high] = self.interval;
        for step in 0..=steps {
            let depth = low + (high - low) * f64::from(step) / f64::from(steps);
            for (range, value) in image.iter_mut().zip(self.encode(&self.powers(depth))) {
                *range = [range[0].min(value), range[1].max(value)];
            }
        }
        image
    }

    /// log2 of the absolute determinant relative to raw moments of depths in [0, 1]: the bits gained over those. The change
    /// from [0, 1] to an interval of length s contributes s^(1 + 2 + .. + m).
    #[must_use]
    pub fn bits_gained(&self) -> f64 {
        let entries = self.matrix.iter().flatten().copied().collect();
        let own = Factors::new(self.count(), entries).map_or(0.0, |f| f.determinant().abs());
        let powers = (self.count() * (self.count() + 1) / 2) as f64;
        own.log2() + powers * (self.interval[1] - self.interval[0]).log2()
    }
}

fn product(matrix: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    matrix
        .iter()
        .map(|row| {
            row.iter()
                .zip(vector)
                .map(|(entry, value)| entry * value)
                .sum()
        })
        .collect()
}

/// A quantisation without what follows from its matrix.
struct Published {
    name: &'static str,
    source: &'static str,
    interval: [f64; 2],
    matrix: Vec<Vec<f64>>,
    offset: Vec<f64>,
    overshoot: f64,
}

impl From<Published> for Quantisation {
    fn from(published: Published) -> Self {
        let size = published.offset.len();
        let mut inverse = vec![vec![0.0; size]; size];
        let entries = published.matrix.iter().flatten().copied().collect();
        // Each of them has an inverse.
        if let Some(factors) = Factors::new(size, entries) {
            for channel in 0..size {
                let mut unit = vec![0.0; size];
                unit[channel] = 1.0;
                for (row, value) in inverse.iter_mut().zip(factors.solve(&unit)) {
                    row[channel] = value;
                }
            }
        }
        Self {
            name: published.name,
            source: published.source,
            interval: published.interval,
            matrix: published.matrix,
            offset: published.offset,
            inverse,
            overshoot: published.overshoot,
        }
    }
}

fn rows<const N: usize>(rows: [[f64; N]; N]) -> Vec<Vec<f64>> {
    rows.map(Vec::from).into()
}

/// All published quantisations.
#[must_use]
pub fn published_quantisations() -> Vec<Quantisation> {
    let root = 3.0_f64.sqrt();
    let published = [
        Published {
            name: "4 moments on [-1, 1]",
            source: "Peters, GDC 2016; Peters et al., JCGT 6(1) 2017",
            interval: [-1.0, 1.0],
            matrix: rows([
                [1.5, 0.0, -2.0, 0.0],
                [0.0, 4.0, 0.0, -4.0],
                [0.5 * root, 0.0, -2.0 / 9.0 * root, 0.0],
                [0.0, 0.5, 0.0, 0.5],
            ]),
            offset: vec![0.5, 0.0, 0.5, 0.0],
            overshoot: 1e-15,
        },
        Published {
            name: "4 moments on [0, 1], theta_4",
            source: "Peters & Klein, i3D 2015",
            interval: [0.0, 1.0],
            matrix: rows([
                [-2.07224649, 32.23703778, -68.571074599, 39.3703274134],
                [13.7948857237, -59.4683975703, 82.0359750338, -35.364903257],
                [0.105877704, -1.9077466311, 9.3496555107, -6.6543490743],
                [9.7924062118, -33.7652110555, 47.9456096605, -23.9728048165],
            ]),
            offset: vec![0.035955884801, 0.0, 0.0, 0.0],
            overshoot: 6.6e-8,
        },
        Published {
            name: "2 moments on [0, 1], theta_2",
            source: "Peters & Klein, i3D 2015",
            interval: [0.0, 1.0],
            matrix: rows([[1.0, 0.0], [4.0, -4.0]]),
            offset: vec![0.0, 0.0],
            overshoot: 0.0,
        },
        Published {
            name: "6 moments on [-1, 1]",
            source: "Peters, GDC 2016",
            interval: [-1.0, 1.0],
            matrix: rows([
                [2.5, 0.0, -10.0, 0.0, 8.0, 0.0],
                [-1.8749986445, 0.0, 4.20757543111, 0.0, -1.83257678661, 0.0],
                [1.26583039016, 0.0, -1.47644882902, 0.0, 0.71061660238, 0.0],
                [0.0, 4.0, 0.0, -4.0, 0.0, 0.0],
                [0.0, 9.0, 0.0, -24.0, 0.0, 16.0],
                [0.0, -0.57759806484, 0.0, 4.61936647543, 0.0, -3.07953906655],
            ]),
            offset: vec![0.5, 0.5, 0.5, 0.0, 0.0, 0.018888946],
            overshoot: 5e-12,
        },
        Published {
            name: "6 moments on [0, 1]",
            source: "Peters et al., supplement of \"Beyond Hard Shadows\", i3D 2016, Table 1",
            interval: [0.0, 1.0],
            matrix: rows([
                [
                    -0.39982174417,
                    5.372499433,
                    -19.400931206,
                    5.9601506283,
                    21.716342727,
                    -14.2481344,
                ],
                [
                    -0.2036458037,
                    61.687438614,
                    -280.26108456,
                    480.86777452,
                    -370.6170286,
                    109.52605942,
                ],
                [
                    35.997693025,
                    -419.96056141,
                    1791.8207666,
                    -3455.6578547,
                    3071.7060681,
                    -1023.906108,
                ],
                [
                    24.253667437,
                    -187.46243964,
                    499.10228252,
                    -516.52881873,
                    144.63179523,
                    37.003250859,
                ],
                [
                    14.571662352,
                    -64.120119623,
                    75.292307128,
                    8.798154992,
                    -43.073239823,
                    8.5315616209,
                ],
                [
                    2.5464326857,
                    -78.04982013,
                    350.77691236,
                    -674.56153641,
                    598.68902736,
                    -199.39897152,
                ],
            ]),
            offset: vec![
                0.9999446933,
                0.0003698424,
                0.0,
                0.0000807802,
                0.0000059274,
                0.9774602669,
            ],
            overshoot: 1e-7,
        },
    ];
    published.map(Quantisation::from).into()
}
