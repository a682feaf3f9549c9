//! Which four functions describe depth best: the i3D 2015 paper's Figure 4 on a smaller scale.
//!
//! The paper tries all 66,045 choices of four among 37 functions. Here all 495 choices of four among twelve bound the shadow
//! intensity for random depth distributions of four surfaces, at receivers on the surfaces and behind them.

use core::fmt;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::function::{Basis, Function};
use crate::oracle::{LinearError, MomentProblem};

/// The functions to choose from, on depths in [0, 1].
pub const CANDIDATES: [Function; 12] = [
    Function::Power(1),
    Function::Power(2),
    Function::Power(3),
    Function::Power(4),
    Function::Power(5),
    Function::Power(6),
    Function::Sine(1),
    Function::Cosine(1),
    Function::Sine(2),
    Function::Cosine(2),
    Function::Root,
    Function::Exponential(4.0),
];

/// How many functions a texel holds the expectations of.
const CHOSEN: usize = 4;

/// Surfaces of a distribution.
const SURFACES: usize = 4;

/// Nodes of the grid. The surfaces and the receiver are nodes as well; mean errors are within 0.2 % of those on 1601 nodes.
const NODES: usize = 129;

/// How far behind a surface receivers lie at most, in units of the depth range.
const BEHIND: f64 = 0.2;

/// Why there is no comparison.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SubsetError {
    /// No sample, no mean.
    #[error("0 samples were asked for; ask for at least 1")]
    NoSamples,
    /// No room is left for surfaces.
    #[error("a margin of {0} leaves no room for surfaces; it must be at least 0 and below 0.5")]
    Margin(f64),
    /// The linear program of a subset has no solution.
    #[error("basis {basis}: {error}")]
    Linear {
        /// The functions.
        basis: String,
        /// Why not.
        error: LinearError,
    },
}

/// A choice of functions and how well it does.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Subset {
    /// Which of [`CANDIDATES`], ascending.
    pub indices: [usize; CHOSEN],
    /// The functions' names.
    pub name: String,
    /// Mean difference of the true shadow intensity and the sharp lower bound.
    pub mean_error: f64,
}

/// All choices, best first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Subsets {
    /// Depth distributions.
    pub samples: usize,
    /// The share of the depth range at either end that is free of surfaces.
    pub margin: f64,
    /// Receivers of all distributions together.
    pub receivers: usize,
    /// The choices by ascending error.
    pub ranked: Vec<Subset>,
}

impl Subsets {
    /// z, z^2, z^3, z^4: the library's.
    pub const POWERS: [usize; CHOSEN] = [0, 1, 2, 3];

    /// Sine and cosine of 2 pi z and 4 pi z: the paper's best.
    pub const TRIGONOMETRIC: [usize; CHOSEN] = [6, 7, 8, 9];

    /// How many choices there are, and how often [`Subsets::evaluate`] calls its `step`.
    pub const COUNT: u64 = 495;

    /// Bounds `samples` distributions with every choice, their surfaces anywhere but within `margin` of the ends of the depth
    /// range: sine and cosine cannot tell one end from the other, so that a margin favours them. The same `seed` gives the
    /// same figures on every machine.
    pub fn evaluate(
        samples: usize,
        margin: f64,
        seed: u64,
        step: impl Fn() + Sync,
    ) -> Result<Self, SubsetError> {
        if samples == 0 {
            return Err(SubsetError::NoSamples);
        }
        if !(0.0..0.5).contains(&margin) {
            return Err(SubsetError::Margin(margin));
        }
        let distributions = distributions(samples, margin, seed);
        let mut ranked = choices()
            .into_par_iter()
            .map(|indices| {
                let subset = judge(indices, &distributions);
                step();
                subset
            })
            .collect::<Result<Vec<Subset>, SubsetError>>()?;
        ranked.sort_by(|one, other| {
            let order = one.mean_error.total_cmp(&other.mean_error);
            order.then_with(|| one.indices.cmp(&other.indices))
        });
        Ok(Self {
            samples,
            margin,
            receivers: distributions.iter().map(|one| one.receivers.len()).sum(),
            ranked,
        })
    }

    /// The rank, from 1, of a choice, and the choice.
    #[must_use]
    pub fn rank(&self, indices: [usize; CHOSEN]) -> Option<(usize, &Subset)> {
        let place = self
            .ranked
            .iter()
            .position(|subset| subset.indices == indices)?;
        Some((place + 1, &self.ranked[place]))
    }
}

struct Distribution {
    atoms: Vec<(f64, f64)>,
    receivers: Vec<f64>,
}

impl Distribution {
    fn shadow(&self, depth: f64) -> f64 {
        self.atoms
            .iter()
            .filter(|atom| atom.0 < depth)
            .map(|atom| atom.1)
            .sum()
    }
}

fn distributions(samples: usize, margin: f64, seed: u64) -> Vec<Distribution> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    (0..samples)
        .map(|_| {
            let mut atoms: Vec<(f64, f64)> = (0..SURFACES)
                .map(|_| {
                    (
                        random.random_range(margin..1.0 - margin),
                        random.random_range(0.05..1.0),
                    )
                })
                .collect();
            let total: f64 = atoms.iter().map(|atom| atom.1).sum();
            for atom in &mut atoms {
                atom.1 /= total;
            }
            let receivers = atoms
                .iter()
                .flat_map(|&(z, _)| [z, (z + random.random_range(0.0..BEHIND)).min(1.0)])
                .collect();
            Distribution { atoms, receivers }
        })
        .collect()
}

/// All sets of four candidates.
fn choices() -> Vec<[usize; CHOSEN]> {
    let count = CANDIDATES.len();
    let mut choices = Vec::new();
    for a in 0..count {
        for b in a + 1..count {
            for c in b + 1..count {
                choices.extend((c + 1..count).map(|d| [a, b, c, d]));
            }
        }
    }
    choices
}

fn judge(indices: [usize; CHOSEN], distributions: &[Distribution]) -> Result<Subset, SubsetError> {
    let basis = Basis {
        functions: indices.map(|index| CANDIDATES[index]).into(),
        interval: [0.0, 1.0],
    };
    let name = basis.to_string();
    let failed = |error| SubsetError::Linear {
        basis: name.clone(),
        error,
    };
    let problem = MomentProblem::new(basis, NODES).map_err(failed)?;
    let mut sum = 0.0;
    let mut count = 0.0;
    for distribution in distributions {
        for &receiver in &distribution.receivers {
            let bound = problem
                .lower_of(&distribution.atoms, receiver)
                .map_err(failed)?;
            sum += distribution.shadow(receiver) - bound.value;
            count += 1.0;
        }
    }
    Ok(Subset {
        indices,
        name,
        mean_error: sum / count,
    })
}

impl fmt::Display for Subsets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let total = self.ranked.len();
        writeln!(
            f,
            "Mean error of the sharp lower bound in percent: {} distributions of {SURFACES} surfaces, {} receivers, margin {}, {total} sets of functions on [0, 1]",
            self.samples, self.receivers, self.margin
        )?;
        let names: Vec<String> = CANDIDATES.iter().map(ToString::to_string).collect();
        writeln!(f, "functions: {}\n", names.join(", "))?;
        let mut row = |rank: usize, subset: &Subset, remark: &str| {
            let percent = 100.0 * subset.mean_error;
            writeln!(
                f,
                "{rank:>4} of {total}  {percent:>7.3}  {}{remark}",
                subset.name
            )
        };
        for (place, subset) in self.ranked.iter().enumerate() {
            let remark = match subset.indices {
                Self::POWERS => "  <- the library's",
                Self::TRIGONOMETRIC => "  <- trigonometric",
                _ if place < 5 || place + 1 == total => "",
                _ => continue,
            };
            row(place + 1, subset, remark)?;
        }
        Ok(())
    }
}
