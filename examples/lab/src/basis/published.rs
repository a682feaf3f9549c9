//! How the papers store moments: affine images that fill the range of normalised channels, and the moment biases for them.
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
    /// The inverse of the matrix as it was published or computed from it with many digits.
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

    /// The largest entry of inverse * matrix - 1.
    #[must_use]
    pub fn inverse_error(&self) -> f64 {
        let size = self.count();
        let mut error = 0.0_f64;
        for row in 0..size {
            for column in 0..size {
                let entry: f64 = (0..size)
                    .map(|k| self.inverse[row][k] * self.matrix[k][column])
                    .sum();
                error = error.max((entry - f64::from(row == column)).abs());
            }
        }
        error
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

fn rows<const N: usize>(rows: [[f64; N]; N]) -> Vec<Vec<f64>> {
    rows.map(Vec::from).into()
}

/// All of them.
#[must_use]
pub fn published_quantisations() -> Vec<Quantisation> {
    let root = 3.0_f64.sqrt();
    vec![
        Quantisation {
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
            inverse: rows([
                [-1.0 / 3.0, 0.0, root, 0.0],
                [0.0, 0.125, 0.0, 1.0],
                [-0.75, 0.0, 0.75 * root, 0.0],
                [0.0, -0.125, 0.0, 1.0],
            ]),
            overshoot: 1e-15,
        },
        Quantisation {
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
            inverse: rows([
                [
                    0.22277441458975105,
                    0.077197286078127291,
                    0.79269866365602851,
                    0.031941755461409701,
                ],
                [
                    0.15496792611583606,
                    0.13946294265353615,
                    0.79634158378587567,
                    -0.17228231730199038,
                ],
                [
                    0.14519889456443683,
                    0.21202021568252677,
                    0.72586944638507082,
                    -0.2758014811491576,
                ],
                [
                    0.16312744299137798,
                    0.25914322664410965,
                    0.65390924967369523,
                    -0.33761317340581743,
                ],
            ]),
            overshoot: 6.6e-8,
        },
        Quantisation {
            name: "2 moments on [0, 1], theta_2",
            source: "Peters & Klein, i3D 2015",
            interval: [0.0, 1.0],
            matrix: rows([[1.0, 0.0], [4.0, -4.0]]),
            offset: vec![0.0, 0.0],
            inverse: rows([[1.0, 0.0], [1.0, -0.25]]),
            overshoot: 0.0,
        },
        Quantisation {
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
            inverse: rows([
                [
                    -0.02877789191977914,
                    0.47635550421232619,
                    1.5524280897137293,
                    0.0,
                    0.0,
                    0.0,
                ],
                [
                    0.0,
                    0.0,
                    0.0,
                    1.2530436076429571e-5,
                    0.16668494186053159,
                    0.86602540579434605,
                ],
                [
                    0.09995235706024454,
                    0.84532580930693434,
                    1.0547257075981561,
                    0.0,
                    0.0,
                    0.0,
                ],
                [
                    0.0,
                    0.0,
                    0.0,
                    -0.24998746956392357,
                    0.16668494186053159,
                    0.86602540579434605,
                ],
                [
                    0.25893353755023666,
                    0.90779616656731599,
                    0.83327335646215471,
                    0.0,
                    0.0,
                    0.0,
                ],
                [
                    0.0,
                    0.0,
                    0.0,
                    -0.37498825271617835,
                    0.21876713299424836,
                    0.81189881793219942,
                ],
            ]),
            overshoot: 5e-12,
        },
        Quantisation {
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
            inverse: rows([
                [
                    -0.79237325966846032,
                    0.23413985733334841,
                    0.036420229235185459,
                    -0.026311192653028002,
                    0.0051060590045215815,
                    -0.0064527692312344136,
                ],
                [
                    -0.79275899603833144,
                    0.23388797405004625,
                    -0.0057927763058036575,
                    -0.026887307924913016,
                    0.0038746589588103988,
                    0.21003901213692863,
                ],
                [
                    -0.73394257210538108,
                    0.27997206660120065,
                    -0.023218014282926559,
                    -0.014368192159273879,
                    0.0085756362293717897,
                    0.32315166678414162,
                ],
                [
                    -0.67488936630569722,
                    0.32714829575892102,
                    -0.030124608752137282,
                    -0.0025883287000990252,
                    -0.0019812866546588332,
                    0.38204444262192322,
                ],
                [
                    -0.62368668548144972,
                    0.3652961959802862,
                    -0.032463881970808181,
                    0.010426190161885508,
                    -0.021325151280361744,
                    0.41293922974898731,
                ],
                [
                    -0.5804097373083305,
                    0.39401512856245769,
                    -0.033672912438249799,
                    0.024972808928384004,
                    -0.043690863815864525,
                    0.42855740033326065,
                ],
            ]),
            overshoot: 1e-7,
        },
    ]
}

/// A moment bias `b + alpha (target - b)` as it was published.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedBias {
    /// What it is for.
    pub name: &'static str,
    /// Where it was published.
    pub source: &'static str,
    /// The least and the greatest depth.
    pub interval: [f64; 2],
    /// The step.
    pub alpha: f64,
    /// b*, the moments towards which the step goes.
    pub target: Vec<f64>,
}

/// All of them.
#[must_use]
pub fn published_biases() -> Vec<PublishedBias> {
    let unit = [0.0, 1.0];
    let signed = [-1.0, 1.0];
    let half = |count: usize| vec![0.5; count];
    // A share of the uniform distribution, whose moments are 1/2, 1/3, ..; the rest at both ends.
    let uniform = |count: i32, share: f64| -> Vec<f64> {
        (1..=count)
            .map(|j| (1.0 - share) * 0.5 + share / f64::from(j + 1))
            .collect()
    };
    let even = |beta: f64| vec![0.0, beta, 0.0, beta];
    let bias = |name, source, interval, alpha, target| PublishedBias {
        name,
        source,
        interval,
        alpha,
        target,
    };
    let first = "Peters & Klein, i3D 2015";
    let supplement = "Peters et al., supplement of \"Beyond Hard Shadows\", i3D 2016";
    let improved = "Peters et al., JCGT 6(1) 2017";
    vec![
        bias("4 moments, f32", first, unit, 2e-6, half(4)),
        bias("4 moments, unorm16", first, unit, 3e-5, half(4)),
        bias(
            "4 moments, unorm16, clamped depth",
            supplement,
            unit,
            3e-5,
            uniform(4, 0.2),
        ),
        bias(
            "6 moments, unorm10",
            supplement,
            unit,
            4e-3,
            uniform(6, 0.5),
        ),
        bias(
            "4 moments, unorm16",
            "Peters, GDC 2016",
            signed,
            6e-5,
            even(0.63),
        ),
        bias("4 moments, f32", improved, signed, 3e-7, even(0.375)),
        bias("4 moments, unorm16", improved, signed, 6e-5, even(0.628)),
    ]
}
