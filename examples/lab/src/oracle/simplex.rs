//! The simplex method for the linear programs of the moment problem: a handful of rows, thousands of columns.
//!
//! General solvers accept violations of constraints by about 1e-7, which acts like a moment bias of this size. With so few
//! rows the basis can be factored anew in each step, so that constraints hold to rounding.

use crate::dense::Factors;

/// Steps until a program counts as hopeless. Dozens are usual.
const MOST_STEPS: usize = 5000;

/// Steps without progress after which Bland's rule, which cannot cycle, takes over.
const STALLED_STEPS: usize = 40;

/// How far the constraints may be violated by the nearest distribution on the columns.
const INFEASIBLE: f64 = 1e-10;

/// What the method ends with, if not with an optimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Failure {
    /// No solution has non-negative entries; the least violation.
    Infeasible(f64),
    /// Rounding got the better of it.
    Stuck,
}

/// A least value, and what proves it.
pub(super) struct Optimum {
    /// The least cost.
    pub(super) value: f64,
    /// A lower bound of the least cost of all solutions whose entries sum to one.
    pub(super) certificate: f64,
}

/// Minimises `costs . x` over x >= 0 with A x = `right`. The columns of A are given one after the other, as long as `right`.
pub(super) fn minimise(columns: &[f64], costs: &[f64], right: &[f64]) -> Result<Optimum, Failure> {
    let mut state = State::new(columns, right);
    // First the least violation: an artificial column per row, each of cost one.
    state.descend(|column| f64::from(column >= costs.len()), true)?;
    let violation: f64 =
        state
            .basic
            .iter()
            .zip(&state.values)
            .fold(0.0, |sum, (&column, value)| {
                if column >= costs.len() {
                    sum + value.abs()
                } else {
                    sum
                }
            });
    if violation.is_nan() || violation > INFEASIBLE {
        return Err(Failure::Infeasible(violation));
    }
    let cost = |column: usize| costs.get(column).copied().unwrap_or(0.0);
    let dual = state.descend(cost, false)?;
    let least = (0..costs.len())
        .map(|column| costs[column] - dot(&dual, state.column(column)))
        .fold(0.0, f64::min);
    let in_use = state.basic.iter().zip(&state.values);
    let in_use = in_use.filter(|&(&column, _)| column < costs.len());
    Ok(Optimum {
        value: in_use
            .map(|(&column, value)| costs[column] * value.max(0.0))
            .sum(),
        certificate: dot(&dual, right) + least,
    })
}

struct State<'a> {
    rows: usize,
    columns: &'a [f64],
    right: &'a [f64],
    /// A column per row, so that a solution to start from is known.
    artificial: Vec<f64>,
    basic: Vec<usize>,
    values: Vec<f64>,
}

impl<'a> State<'a> {
    fn new(columns: &'a [f64], right: &'a [f64]) -> Self {
        let rows = right.len();
        let count = columns.len() / rows;
        let mut artificial = vec![0.0; rows * rows];
        for (row, value) in right.iter().enumerate() {
            artificial[row * (rows + 1)] = if *value < 0.0 { -1.0 } else { 1.0 };
        }
        Self {
            rows,
            columns,
            right,
            artificial,
            basic: (count..count + rows).collect(),
            values: right.iter().map(|value| value.abs()).collect(),
        }
    }

    fn real_columns(&self) -> usize {
        self.columns.len() / self.rows
    }

    fn column(&self, index: usize) -> &[f64] {
        let count = self.real_columns();
        let (list, index) = if index < count {
            (self.columns, index)
        } else {
            (self.artificial.as_slice(), index - count)
        };
        &list[index * self.rows..(index + 1) * self.rows]
    }

    /// Exchanges columns until no exchange lowers the cost; returns the dual solution.
    fn descend(
        &mut self,
        cost: impl Fn(usize) -> f64,
        first_phase: bool,
    ) -> Result<Vec<f64>, Failure> {
        let count = self.real_columns();
        let costs: Vec<f64> = (0..count).map(&cost).collect();
        let mut best = f64::INFINITY;
        let mut stalled = 0;
        for _ in 0..MOST_STEPS {
            let factors = self.factor()?;
            self.values = factors.solve(self.right);
            let basic_costs: Vec<f64> = self.basic.iter().map(|&column| cost(column)).collect();
            let dual = factors.solve_transposed(&basic_costs);
            let value = dot(&basic_costs, &self.values);
            if value < best - 1e-14 {
                (best, stalled) = (value, 0);
            } else {
                stalled += 1;
            }
            let bland = stalled > STALLED_STEPS;
            let size = dual
                .iter()
                .fold(1.0_f64, |size, entry| size.max(entry.abs()));
            let tolerance = 1e-13 * size;
            let Some(entering) = self.entering(&costs, &dual, tolerance, bland) else {
                return Ok(dual);
            };
            let direction = factors.solve(self.column(entering));
            let Some(leaving) = self.leaving(&direction, first_phase, bland) else {
                return Err(Failure::Stuck);
            };
            self.basic[leaving] = entering;
        }
        Err(Failure::Stuck)
    }

    fn factor(&self) -> Result<Factors, Failure> {
        let mut matrix = vec![0.0; self.rows * self.rows];
        for (place, &column) in self.basic.iter().enumerate() {
            for (row, value) in self.column(column).iter().enumerate() {
                matrix[row * self.rows + place] = *value;
            }
        }
        Factors::new(self.rows, matrix).ok_or(Failure::Stuck)
    }

    /// The column whose reduced cost is lowest (the first negative one by Bland's rule).
    fn entering(&self, costs: &[f64], dual: &[f64], tolerance: f64, bland: bool) -> Option<usize> {
        let mut least = -tolerance;
        let mut entering = None;
        for (index, (column, cost)) in self.columns.chunks_exact(self.rows).zip(costs).enumerate() {
            let reduced = cost - dot(dual, column);
            if reduced < least && !self.basic.contains(&index) {
                (least, entering) = (reduced, Some(index));
                if bland {
                    break;
                }
            }
        }
        entering
    }

    /// The place in the basis whose value reaches zero first; among several the one with the largest pivot.
    fn leaving(&self, direction: &[f64], first_phase: bool, bland: bool) -> Option<usize> {
        let count = self.real_columns();
        let size = direction
            .iter()
            .fold(0.0_f64, |size, entry| size.max(entry.abs()));
        let smallest = 1e-10 * size;
        let mut step = f64::INFINITY;
        let mut leaving: Option<usize> = None;
        for (place, &slope) in direction.iter().enumerate() {
            // In the second phase an artificial column is zero and has to stay so.
            let fixed = !first_phase && self.basic[place] >= count;
            let ratio = if fixed && slope.abs() > smallest {
                0.0
            } else if slope > smallest {
                self.values[place].max(0.0) / slope
            } else {
                continue;
            };
            let better = match leaving {
                None => true,
                Some(_) if ratio < step - 1e-14 => true,
                Some(other) if ratio <= step + 1e-14 => {
                    if bland {
                        self.basic[place] < self.basic[other]
                    } else {
                        slope.abs() > direction[other].abs()
                    }
                }
                Some(_) => false,
            };
            if better {
                leaving = Some(place);
                step = step.min(ratio);
            }
        }
        leaving
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
