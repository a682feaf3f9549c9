//! The stability report: every technique with every storage on inputs of all kinds, against the truth in f64.
//!
//! An input is a mixture of surfaces, a filtered patch of them, or a texel that nothing valid made, with a fragment. The
//! techniques run on the adapter, through the adapters that the nodes link and with every stage rounded to the storage; the
//! truth is counted from the surfaces on the processor, and knows nothing of moments.

mod climb;
mod gauss_node;
pub mod input;
mod invalid;
pub mod judge;
pub mod kernels;
pub mod limits;
pub mod plot;
pub mod report;
pub mod shader;
pub mod strata;
pub mod truth;

use moment_shadows::MapEncoding;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::error::LabError;
use crate::gpu::Gpu;
pub use climb::CLIMBS;
use input::Input;
use judge::Tally;
use report::{Report, Row};
use shader::Evaluator;
use strata::Stratum;

/// How much is tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Effort {
    /// Inputs per technique and storage, in equal shares of all strata (rounded up).
    pub samples: u64,
    /// Steps of each hill-climb.
    pub steps: u32,
    /// Seed of the random inputs: the same seed gives the same inputs.
    pub seed: u64,
}

impl Effort {
    /// 10^7 inputs.
    pub const FULL: Effort = Effort {
        samples: 10_000_000,
        steps: 100,
        seed: 1,
    };
    /// 10^5 inputs.
    pub const QUICK: Effort = Effort {
        samples: 100_000,
        steps: 20,
        ..Effort::FULL
    };
}

impl core::fmt::Display for Effort {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "{} inputs per technique and storage, {CLIMBS} hill-climbs of {} steps, seed {}",
            self.samples, self.steps, self.seed
        )
    }
}

/// Inputs of each stratum that are made at a time.
const CHUNK: u64 = 1 << 15;

/// Tries every pair on the same inputs. `step` is called [`steps`] times.
pub fn run(
    gpu: &Gpu,
    pairs: &[MapEncoding],
    effort: Effort,
    step: impl Fn(),
) -> Result<Report, LabError> {
    let evaluators: Vec<Evaluator<'_>> = pairs
        .par_iter()
        .map(|pair| Evaluator::new(gpu, pair))
        .collect::<Result<_, _>>()?;
    let mut tallies = vec![Tally::default(); pairs.len()];
    let each = per_stratum(effort.samples);
    let kernels = kernels::kernels()?;
    for (chunk, first) in (0..).zip((0..each).step_by(CHUNK as usize)) {
        let count = CHUNK.min(each - first) as usize;
        let inputs: Vec<Input> = Stratum::ALL
            .into_par_iter()
            .flat_map_iter(|stratum| {
                let mut random = ChaCha8Rng::seed_from_u64(effort.seed);
                // Streams of the generator are independent.
                random.set_stream(chunk * Stratum::ALL.len() as u64 + stratum as u64);
                (0..count).map(move |_| stratum.sample(&mut random))
            })
            .collect();
        let truths: Vec<Option<f64>> = inputs
            .par_iter()
            .map(|input| truth::truth(input, &kernels))
            .collect();
        for (evaluator, tally) in evaluators.iter().zip(&mut tallies) {
            let found = evaluator.run(&inputs)?;
            for (index, found) in found.into_iter().enumerate() {
                let stratum = Stratum::ALL[index / count];
                tally.add(stratum, &inputs[index], truths[index], found);
            }
            step();
        }
    }
    let mut rows = Vec::new();
    for ((pair, evaluator), tally) in pairs.iter().zip(&evaluators).zip(tallies) {
        let climbed = climb::climb(evaluator, &tally, effort.steps, effort.seed)?;
        rows.push(Row::new(pair, &tally, &climbed));
        step();
    }
    Ok(Report {
        adapter: gpu.adapter.get_info().name,
        effort,
        rows,
    })
}

/// How many steps [`run`] takes.
#[must_use]
pub fn steps(pairs: usize, effort: Effort) -> u64 {
    pairs as u64 * (per_stratum(effort.samples).div_ceil(CHUNK) + 1)
}

fn per_stratum(samples: u64) -> u64 {
    samples.div_ceil(Stratum::ALL.len() as u64).max(1)
}
