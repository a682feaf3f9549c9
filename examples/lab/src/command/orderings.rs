//! `moment-shadows orderings`: the bounds of techniques on identical surfaces, without errors of storage, while the light's
//! depth range grows around them.
//!
//! A range s times as large is an affine map of moment depth. The sharp bound of power moments does not change with it. A
//! moment bias has a fixed size in moment depth, ESM's exponent and the terms of a Fourier series have one too, so these
//! leak s times as far in the scene (the bias: sqrt(alpha) of the range).

use core::fmt;

use moment_shadows::{FourMomentsBias, Storage};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use crate::oracle::ideal::{FourierSeries, Ideal};

/// By how much the depth range grows.
const SCALES: [f64; 7] = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];

/// A technique's mean leak for each range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OrderingRow {
    /// Its name.
    pub technique: String,
    /// Mean difference of the true shadow intensity and the bound, per scale.
    pub leaks: Vec<f64>,
    /// The most by which the bound exceeds the truth, over all scales.
    pub excess: f64,
}

/// All rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Orderings {
    /// Depth distributions.
    pub samples: usize,
    /// Of the random numbers.
    pub seed: u64,
    /// By how much the depth range grows.
    pub scales: Vec<f64>,
    /// Technique by technique.
    pub rows: Vec<OrderingRow>,
}

/// Surfaces and a receiver.
struct Sample {
    depths: Vec<f64>,
    weights: Vec<f64>,
    receiver: f64,
    truth: f64,
}

/// Judges every technique on `samples` distributions of two to four surfaces, with receivers on them and behind.
#[must_use]
pub fn run(samples: usize, seed: u64) -> Orderings {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let samples: Vec<Sample> = (0..samples).map(|_| sample(&mut random)).collect();
    let mut subjects: Vec<(String, Subject)> = vec![(
        Ideal::Hamburger4.to_string(),
        Subject {
            technique: Ideal::Hamburger4,
            bias: None,
        },
    )];
    for storage in Storage::OF_FOUR_MOMENTS {
        let bias = storage.moment_bias();
        let subject = Subject {
            technique: Ideal::Hamburger4,
            bias: Some(bias),
        };
        subjects.push((
            format!("- with the bias of {storage}, {}", bias.alpha),
            subject,
        ));
    }
    let others = [
        Ideal::Hamburger6,
        Ideal::Hausdorff4,
        Ideal::Vsm,
        Ideal::Lvsm {
            layers: 4,
            overlap: 0.1,
        },
        Ideal::Esm { exponent: 40.0 },
        Ideal::Evsm2 { exponent: 40.0 },
        Ideal::Evsm4 {
            positive: 40.0,
            negative: 5.0,
        },
        Ideal::Convolution(FourierSeries::new(16, 1.0)),
    ];
    subjects.extend(others.map(|technique| {
        let name = technique.to_string();
        let subject = Subject {
            technique,
            bias: None,
        };
        (name, subject)
    }));
    let rows = subjects
        .into_iter()
        .map(|(technique, subject)| {
            let figures: Vec<(f64, f64)> = SCALES
                .iter()
                .map(|&scale| subject.judge(&samples, scale))
                .collect();
            OrderingRow {
                technique,
                leaks: figures.iter().map(|figure| figure.0).collect(),
                excess: figures.iter().map(|figure| figure.1).fold(0.0, f64::max),
            }
        })
        .collect();
    Orderings {
        samples: samples.len(),
        seed,
        scales: SCALES.into(),
        rows,
    }
}

fn sample(random: &mut ChaCha8Rng) -> Sample {
    let count = random.random_range(2..=4);
    let depths: Vec<f64> = (0..count).map(|_| random.random_range(-1.0..1.0)).collect();
    let mut weights: Vec<f64> = (0..count).map(|_| random.random_range(0.05..1.0)).collect();
    let total: f64 = weights.iter().sum();
    for weight in &mut weights {
        *weight /= total;
    }
    let behind = if random.random() {
        random.random_range(0.0..0.4)
    } else {
        0.0
    };
    let receiver: f64 = (depths[0] + behind).min(1.0);
    let truth = depths
        .iter()
        .zip(&weights)
        .filter(|(depth, _)| **depth < receiver)
        .map(|(_, weight)| weight)
        .sum();
    Sample {
        depths,
        weights,
        receiver,
        truth,
    }
}

struct Subject {
    technique: Ideal,
    bias: Option<FourMomentsBias>,
}

impl Subject {
    /// Mean leak and largest excess for a depth range `scale` times as large about its middle.
    fn judge(&self, samples: &[Sample], scale: f64) -> (f64, f64) {
        let leaks: Vec<f64> = samples
            .par_iter()
            .map(|sample| sample.truth - self.bound(sample, scale))
            .collect();
        let mean = leaks.iter().sum::<f64>() / leaks.len() as f64;
        (mean, leaks.iter().map(|leak| -leak).fold(0.0, f64::max))
    }

    fn bound(&self, sample: &Sample, scale: f64) -> f64 {
        let mut depths: Vec<f64> = sample.depths.iter().map(|depth| depth / scale).collect();
        let mut weights = sample.weights.clone();
        if let Some(bias) = self.bias {
            // A share alpha of occluders at the near end, the middle and the far end: their second moment is their fourth.
            let (alpha, beta) = (f64::from(bias.alpha), f64::from(bias.second));
            for weight in &mut weights {
                *weight *= 1.0 - alpha;
            }
            depths.extend([-1.0, 0.0, 1.0]);
            weights.extend([0.5 * beta, 1.0 - beta, 0.5 * beta].map(|weight| alpha * weight));
        }
        self.technique
            .lower_bound(&depths, &weights, sample.receiver / scale)
    }
}

impl fmt::Display for Orderings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Mean leak of lower bounds in percent, {} distributions of two to four surfaces, seed {}, by growth of the depth range\n",
            self.samples, self.seed
        )?;
        write!(f, "| technique |")?;
        for scale in &self.scales {
            write!(f, " x{scale} |")?;
        }
        writeln!(f, " excess |")?;
        writeln!(f, "|{}", "---|".repeat(self.scales.len() + 2))?;
        for row in &self.rows {
            write!(f, "| {} |", row.technique)?;
            for leak in &row.leaks {
                write!(f, " {:.3} |", 100.0 * leak)?;
            }
            writeln!(f, " {:.1e} |", row.excess)?;
        }
        Ok(())
    }
}
