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
pub mod packed_limits;
pub mod plot;
pub mod report;
pub mod shader;
pub mod strata;
pub mod truth;
pub mod unfinished;

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
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Effort {
    /// Inputs per technique and storage, in equal shares of all strata (rounded up).
    pub inputs: u64,
    /// Steps of each hill-climb.
    pub steps: u32,
    /// Seed of the random inputs: the same seed gives the same inputs.
    pub seed: u64,
}

impl Effort {
    /// 10^7 inputs.
    pub const FULL: Effort = Effort {
        inputs: 10_000_000,
        steps: 100,
        seed: 1,
    };
    /// 10^5 inputs.
    pub const QUICK: Effort = Effort {
        inputs: 100_000,
        steps: 20,
        ..Effort::FULL
    };
}

impl core::fmt::Display for Effort {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        write!(
            f,
            "{} inputs per technique and storage, {CLIMBS} hill-climbs of {} steps, seed {}",
            self.inputs, self.steps, self.seed
        )
    }
}

/// Inputs of each stratum that are made at a time.
const CHUNK: u64 = 1 << 15;

/// How far a run has come.
#[derive(Clone, Debug)]
pub struct Progress {
    /// Inputs are made in chunks. The number of the next one.
    next: u64,
    /// The counts over those before, by pair.
    tallies: Vec<Tally>,
}

impl Progress {
    /// Where a run of so many pairs begins.
    #[must_use]
    pub fn none(pairs: usize) -> Self {
        Self {
            next: 0,
            tallies: vec![Tally::default(); pairs],
        }
    }

    /// A run of so many pairs that has come somewhere; none if the counts are not those of such a run.
    fn of(pairs: usize, next: u64, tallies: Vec<Tally>) -> Option<Self> {
        let fits = tallies.len() == pairs && tallies.iter().all(Tally::is_whole);
        fits.then_some(Self { next, tallies })
    }
}

/// Tries every pair on the same inputs, from where the run has come to. `keep` is called after each chunk. `step` is called as often
/// as [`steps`] says.
pub fn run(
    gpu: &Gpu,
    pairs: &[MapEncoding],
    effort: Effort,
    mut progress: Progress,
    mut keep: impl FnMut(&Progress) -> Result<(), LabError>,
    step: impl Fn(u64),
) -> Result<Report, LabError> {
    let evaluators: Vec<Evaluator<'_>> = pairs
        .par_iter()
        .map(|pair| Evaluator::new(gpu, pair))
        .collect::<Result<_, _>>()?;
    let each = per_stratum(effort.inputs);
    let kernels = kernels::kernels()?;
    let chunks = each.div_ceil(CHUNK);
    step(progress.next.min(chunks) * pairs.len() as u64);
    for chunk in progress.next..chunks {
        let count = CHUNK.min(each - chunk * CHUNK) as usize;
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
        for (evaluator, tally) in evaluators.iter().zip(&mut progress.tallies) {
            let found = evaluator.run(&inputs)?;
            for (index, found) in found.into_iter().enumerate() {
                let stratum = Stratum::ALL[index / count];
                tally.add(stratum, &inputs[index], truths[index], found);
            }
            step(1);
        }
        progress.next = chunk + 1;
        keep(&progress)?;
    }
    let mut rows = Vec::new();
    for ((pair, evaluator), tally) in pairs.iter().zip(&evaluators).zip(progress.tallies) {
        let climbed = climb::climb(evaluator, &tally, effort.steps, effort.seed)?;
        rows.push(Row::new(pair, &tally, &climbed));
        step(1);
    }
    Ok(Report {
        adapter: gpu.described(),
        effort,
        rows,
    })
}

/// How many steps [`run`] takes.
#[must_use]
pub fn steps(pairs: usize, effort: Effort) -> u64 {
    pairs as u64 * (per_stratum(effort.inputs).div_ceil(CHUNK) + 1)
}

fn per_stratum(inputs: u64) -> u64 {
    inputs.div_ceil(Stratum::ALL.len() as u64).max(1)
}
