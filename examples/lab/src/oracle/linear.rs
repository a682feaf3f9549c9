//! The moment problem for powers of depth, by linear programming (Peters & Klein, "Moment Shadow Mapping", i3D 2015,
//! Algorithm 1).
//!
//! The distributions considered put their mass on the nodes of a grid and on the fragment depth; where the distribution is
//! known, on its own surfaces too, so that there always is one with the given moments. A finer grid has more distributions:
//! the lower bound falls towards the sharp one and the upper bound rises. The paper also adds the fragment's left
//! neighbour, for a supremum of S(z < depth); the upper bound here is that of S(z <= depth), which the fragment depth itself
//! serves, as it does the lower bound.
//!
//! Moments are rounded to f64, which acts like a moment bias of 1e-16: bounds are good to 1e-9 where surfaces are spread over
//! a good part of the interval. Each comes with a certificate, which says how good it is.

use super::simplex::{Failure, minimise};

/// Why there is no bound.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LinearError {
    /// Nothing can be interpolated on so few nodes.
    #[error("a grid of {0} nodes was asked for; it needs more than there are powers")]
    TooFewNodes(usize),
    /// Rounding made a power a combination of lower ones.
    #[error(
        "depth to the power of {0} depends linearly on lower powers up to rounding; ask for fewer"
    )]
    Dependent(usize),
    /// The wrong number of moments.
    #[error("{given} moments were given for {expected} powers")]
    MomentCount {
        /// How many there are.
        given: usize,
        /// How many there should be.
        expected: usize,
    },
    /// A mixture without a surface of positive weight, or with one outside of the interval.
    #[error(
        "the mixture has no surfaces, or a surface outside of the interval, or a negative weight"
    )]
    Mixture,
    /// The fragment lies outside of the interval.
    #[error("the fragment depth {0} lies outside of the interval")]
    Depth(f64),
    /// No distribution on the grid has the moments.
    #[error(
        "no distribution on the grid has these moments: the nearest misses them by {0:e}; refine the grid or bias the moments"
    )]
    Infeasible(f64),
    /// Rounding kept the simplex method from an optimum.
    #[error(
        "the simplex method found no optimum; the moments are too close to the boundary of the moment space"
    )]
    Stuck,
}

/// A bound with its proof.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearBound {
    /// The shadow intensity of an extremal distribution on the nodes.
    pub value: f64,
    /// What no distribution on the nodes passes, by duality: at most `value` for lower bounds, at least for upper ones, and
    /// the same up to rounding.
    pub certificate: f64,
}

/// Powers of depth on a grid, made ready for many distributions.
///
/// They are made orthonormal on the grid first, so that they are well conditioned.
#[derive(Clone, Debug)]
pub struct MomentProblem {
    interval: [f64; 2],
    nodes: Vec<f64>,
    /// Orthonormal polynomials at the nodes, node by node.
    rows: Vec<f64>,
    /// Lower triangle, row by row: the orthonormal polynomials by their coefficients.
    transform: Vec<Vec<f64>>,
}

/// Which of the two bounds.
#[derive(Clone, Copy)]
enum Side {
    Lower,
    Upper,
}

impl MomentProblem {
    /// The powers from 1 to `powers` on a uniform grid of `count` nodes, ends included.
    pub fn new(powers: usize, interval: [f64; 2], count: usize) -> Result<Self, LinearError> {
        let size = powers + 1;
        if count <= size {
            return Err(LinearError::TooFewNodes(count));
        }
        let [low, high] = interval;
        let nodes: Vec<f64> = (0..count)
            .map(|index| {
                let part = index as f64 / (count - 1) as f64;
                (1.0 - part) * low + part * high
            })
            .collect();
        let transform = orthonormalise(size, &nodes)?;
        let mut problem = Self {
            interval,
            nodes,
            rows: Vec::new(),
            transform,
        };
        problem.rows = problem.nodes.iter().flat_map(|&z| problem.row(z)).collect();
        Ok(problem)
    }

    /// inf S(z < depth) for given moments.
    pub fn lower(&self, moments: &[f64], depth: f64) -> Result<LinearBound, LinearError> {
        self.bound(&self.given(moments)?, &[], depth, Side::Lower)
    }

    /// sup S(z <= depth) for given moments.
    pub fn upper(&self, moments: &[f64], depth: f64) -> Result<LinearBound, LinearError> {
        self.bound(&self.given(moments)?, &[], depth, Side::Upper)
    }

    /// inf S(z < depth) for the moments of surfaces as (depth, weight), whose weights are scaled to sum to 1.
    pub fn lower_of(&self, atoms: &[(f64, f64)], depth: f64) -> Result<LinearBound, LinearError> {
        self.bound(&self.of_mixture(atoms)?, atoms, depth, Side::Lower)
    }

    /// sup S(z <= depth) for the moments of surfaces, as [`MomentProblem::lower_of`].
    pub fn upper_of(&self, atoms: &[(f64, f64)], depth: f64) -> Result<LinearBound, LinearError> {
        self.bound(&self.of_mixture(atoms)?, atoms, depth, Side::Upper)
    }

    /// Expectations of the orthonormal polynomials.
    fn given(&self, moments: &[f64]) -> Result<Vec<f64>, LinearError> {
        let expected = self.transform.len() - 1;
        if moments.len() != expected {
            return Err(LinearError::MomentCount {
                given: moments.len(),
                expected,
            });
        }
        let moments: Vec<f64> = core::iter::once(1.0)
            .chain(moments.iter().copied())
            .collect();
        Ok(self.apply(&moments))
    }

    fn of_mixture(&self, atoms: &[(f64, f64)]) -> Result<Vec<f64>, LinearError> {
        let [low, high] = self.interval;
        let total: f64 = atoms.iter().map(|atom| atom.1).sum();
        let sound = |&(z, weight): &(f64, f64)| (low..=high).contains(&z) && weight >= 0.0;
        if !(total > 0.0 && total.is_finite() && atoms.iter().all(sound)) {
            return Err(LinearError::Mixture);
        }
        let mut moments = vec![0.0; self.transform.len()];
        for &(z, weight) in atoms {
            for (moment, value) in moments.iter_mut().zip(self.row(z)) {
                *moment += weight / total * value;
            }
        }
        Ok(moments)
    }

    fn bound(
        &self,
        moments: &[f64],
        atoms: &[(f64, f64)],
        depth: f64,
        side: Side,
    ) -> Result<LinearBound, LinearError> {
        let [low, high] = self.interval;
        if !(low..=high).contains(&depth) {
            return Err(LinearError::Depth(depth));
        }
        let extra: Vec<f64> = core::iter::once(depth)
            .chain(atoms.iter().map(|atom| atom.0))
            .collect();
        let mut columns = self.rows.clone();
        columns.extend(extra.iter().flat_map(|&z| self.row(z)));
        let nodes = || self.nodes.iter().chain(&extra).copied();
        // The greatest share up to the fragment leaves the least share behind it.
        let costs: Vec<f64> = nodes()
            .map(|z| match side {
                Side::Lower => f64::from(z < depth),
                Side::Upper => f64::from(z > depth),
            })
            .collect();
        let optimum = minimise(&columns, &costs, moments).map_err(|failure| match failure {
            Failure::Infeasible(violation) => LinearError::Infeasible(violation),
            Failure::Stuck => LinearError::Stuck,
        })?;
        let share = |value: f64| match side {
            Side::Lower => value,
            Side::Upper => 1.0 - value,
        };
        Ok(LinearBound {
            value: share(optimum.value),
            certificate: share(optimum.certificate),
        })
    }

    /// The orthonormal polynomials at depth `z`.
    fn row(&self, z: f64) -> Vec<f64> {
        let values: Vec<f64> = powers(z).take(self.transform.len()).collect();
        self.apply(&values)
    }

    fn apply(&self, values: &[f64]) -> Vec<f64> {
        self.transform
            .iter()
            .map(|row| {
                row.iter()
                    .zip(values)
                    .map(|(factor, value)| factor * value)
                    .sum()
            })
            .collect()
    }
}

/// 1, z, z^2, ...
fn powers(z: f64) -> impl Iterator<Item = f64> {
    (0..).map(move |power| z.powi(power))
}

/// Gram and Schmidt's method on the nodes, each power being made orthogonal twice.
fn orthonormalise(size: usize, nodes: &[f64]) -> Result<Vec<Vec<f64>>, LinearError> {
    let mut values: Vec<Vec<f64>> = vec![Vec::with_capacity(nodes.len()); size];
    for &z in nodes {
        for (list, value) in values.iter_mut().zip(powers(z)) {
            list.push(value);
        }
    }
    let mean = |one: &[f64], other: &[f64]| {
        let sum: f64 = one.iter().zip(other).map(|(one, other)| one * other).sum();
        sum / nodes.len() as f64
    };
    let mut transform: Vec<Vec<f64>> = Vec::with_capacity(size);
    for index in 0..size {
        let mut row = vec![0.0; size];
        row[index] = 1.0;
        let mut own = values[index].clone();
        let before = mean(&own, &own);
        for _ in 0..2 {
            for (other, other_row) in values.iter().zip(&transform) {
                let overlap = mean(&own, other);
                for (value, other) in own.iter_mut().zip(other) {
                    *value -= overlap * other;
                }
                for (entry, other) in row.iter_mut().zip(other_row) {
                    *entry -= overlap * other;
                }
            }
        }
        let norm = mean(&own, &own);
        // Below this, nothing but rounding is left of the power.
        if !(norm > 1e-24 * before && norm.is_finite()) {
            return Err(LinearError::Dependent(index));
        }
        let scale = 1.0 / norm.sqrt();
        values[index] = own.iter().map(|value| value * scale).collect();
        transform.push(row.iter().map(|entry| entry * scale).collect());
    }
    Ok(transform)
}
