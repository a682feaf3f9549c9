//! Hill-climbs: from the worst inputs that were drawn, and from others, towards a greater excess.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::input::Input;
use super::judge::{Case, Tally};
use super::kernels;
use super::shader::Evaluator;
use super::strata::{Stratum, normalise};
use super::truth::truth;
use crate::error::LabError;

/// Climbs per technique and storage.
pub const CLIMBS: usize = 200;

/// Changed inputs that a climb chooses from in every step.
const MUTANTS: usize = 4;

/// Climbs `steps` steps from the worst inputs of a tally and from fresh ones, and counts all that was tried.
pub(super) fn climb(
    evaluator: &Evaluator<'_>,
    drawn: &Tally,
    steps: u32,
    seed: u64,
) -> Result<Tally, LabError> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut climbs: Vec<(Stratum, Case)> = Stratum::ALL
        .into_iter()
        .zip(&drawn.strata)
        .flat_map(|(stratum, tally)| tally.worst.iter().map(move |case| (stratum, *case)))
        .take(CLIMBS / 2)
        .collect();
    while climbs.len() < CLIMBS {
        let stratum = Stratum::ALL[random.random_range(0..Stratum::ALL.len())];
        let input = stratum.sample(&mut random);
        if let Some(truth) = truth(&input, evaluator.kernels()) {
            // Whatever is found first is higher.
            let found = f32::MIN;
            climbs.push((
                stratum,
                Case {
                    input,
                    truth,
                    found,
                },
            ));
        }
    }
    let mut tally = Tally::default();
    for _ in 0..steps {
        let mutants: Vec<Input> = climbs
            .iter()
            .flat_map(|(_, case)| [case.input; MUTANTS])
            .map(|input| mutated(input, &mut random))
            .collect();
        let found = evaluator.run(&mutants)?;
        let results = mutants.chunks(MUTANTS).zip(found.chunks(MUTANTS));
        for ((stratum, case), (mutants, found)) in climbs.iter_mut().zip(results) {
            for (&input, &found) in mutants.iter().zip(found) {
                let truth = truth(&input, evaluator.kernels());
                tally.add(*stratum, &input, truth, found);
                let Some(truth) = truth else { continue };
                let mutant = Case {
                    input,
                    truth,
                    found,
                };
                if mutant.excess() > case.excess() {
                    *case = mutant;
                }
            }
        }
    }
    Ok(tally)
}

/// The input with one thing changed, or two.
fn mutated(mut input: Input, random: &mut ChaCha8Rng) -> Input {
    change(&mut input, random);
    if random.random() {
        change(&mut input, random);
    }
    input
}

/// A depth a little farther or nearer; by a share of itself where its unit is not known.
fn nudged(depth: f32, input: &Input, random: &mut ChaCha8Rng) -> f32 {
    let size = 10.0_f64.powf(random.random_range(-9.0..-0.5));
    let step = if random.random() { size } else { -size };
    if input.converted == 1 {
        return (f64::from(depth) * (1.0 + step)) as f32;
    }
    (f64::from(depth) + step).clamp(-1.0, 1.0) as f32
}

fn change(input: &mut Input, random: &mut ChaCha8Rng) {
    let count = input.count.clamp(1, 8) as usize;
    let index = random.random_range(0..count);
    match random.random_range(0..8) {
        0 | 1 => input.depths[index] = nudged(input.depths[index], input, random),
        2 | 3 => input.fragment_depth = nudged(input.fragment_depth, input, random),
        4 => input.fragment_depth = input.depths[index],
        5 => {
            let other = input.depths[random.random_range(0..count)];
            input.depths[index] = nudged(other, input, random);
        }
        _ if input.kind == Input::PATCH => change_pattern(input, random),
        _ => {
            input.weights[index] *= 10.0_f32.powf(random.random_range(-1.0..1.0));
            normalise(&mut input.weights);
        }
    }
}

fn change_pattern(input: &mut Input, random: &mut ChaCha8Rng) {
    match random.random_range(0..6) {
        0 => input.rows[random.random_range(0..2)] = random.random(),
        1 => input.column = random.random(),
        2 => input.row_run = random.random_range(1..=129),
        3 => input.column_run = random.random_range(1..=129),
        4 => input.coverage = random.random_range(0..4),
        // Limits are different for wide kernels.
        _ if input.kernel < kernels::NARROW => {
            input.kernel = random.random_range(0..kernels::NARROW);
        }
        _ => input.kernel = random.random_range(kernels::NARROW..kernels::COUNT),
    }
}
