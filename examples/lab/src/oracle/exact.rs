//! The sharp bounds of shadow intensity for exactly given moments, over distributions on the whole real line (Peters &
//! Klein, i3D 2015, Algorithm 2).

use core::cmp::Ordering;

use dashu::rational::RBig;

use super::polynomial::{Real, deflate, evaluate, real, roots};

/// Why there are no bounds.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OracleError {
    /// The Hamburger problem needs an even number of moments.
    #[error("{0} moments were given; the sharp bounds need an even number of them, at least 2")]
    MomentCount(usize),
    /// No distribution has these moments.
    #[error(
        "no distribution on the real line has these moments: their Hankel matrix is not positive semi-definite \
         or not of the rank of its leading block; apply a larger moment bias"
    )]
    NotMoments,
    /// A mixture without a surface is not a distribution.
    #[error("the mixture has no surface of positive weight")]
    NoSurface,
    /// Not a number, or infinite.
    #[error("{0} is not a finite number")]
    NotFinite(f64),
    /// An interval without length.
    #[error("the interval [{0}, {1}] is empty; its first end must lie below its second")]
    EmptyInterval(f64, f64),
    /// No distribution on the interval has these moments.
    #[error(
        "no distribution on the interval has these moments: a Hankel matrix of theirs is not positive semi-definite; \
         apply a larger moment bias, towards moments inside of the interval's moment space"
    )]
    NotOnInterval,
}

/// The exact value of a finite number.
pub fn rational(value: f64) -> Result<RBig, OracleError> {
    RBig::try_from(value).map_err(|_| OracleError::NotFinite(value))
}

/// A point of an extremal distribution's support.
#[derive(Clone, Debug)]
pub struct SupportPoint {
    /// Its moment depth.
    pub position: Real,
    /// Its share of the distribution, in (0, 1].
    pub weight: Real,
    /// Whether it lies before, at or behind the fragment.
    pub side: Ordering,
    /// Whether it is an end of the interval that bounds the distributions; never on the whole real line.
    pub at_end: bool,
}

/// The distribution for which shadow intensity takes its extreme values, and these values.
#[derive(Clone, Debug)]
pub struct Extremal {
    /// inf S(z < depth) over all distributions S on the real line with the moments.
    pub lower: f64,
    /// sup S(z <= depth) over the same distributions.
    pub upper: f64,
    /// Whether the moments belong to a single distribution (their Hankel matrix is singular); the support is then that
    /// distribution's own.
    pub unique: bool,
    /// The support in ascending order. A point at infinity, whose weight is zero, is left out.
    pub points: Vec<SupportPoint>,
}

/// The sharp bounds for moments b_1..b_m (m even) at a fragment of moment depth `depth`.
pub fn hamburger(moments: &[RBig], depth: &RBig) -> Result<Extremal, OracleError> {
    let moments = with_mass(moments)?;
    let size = moments.len() / 2 + 1;
    let rank = hankel_rank(&moments, size)?;
    if rank < size {
        let (support, at_fragment) = unique_support(&moments, rank, depth);
        let support = Support {
            roots: support,
            ends: Vec::new(),
            at_fragment,
        };
        return Ok(support.extremal(&moments, depth, true));
    }
    let support = Support {
        roots: kernel_roots(&moments, size, depth),
        ends: Vec::new(),
        at_fragment: true,
    };
    Ok(support.extremal(&moments, depth, false))
}

/// b_0..b_m with b_0 = 1, if m is even.
pub(super) fn with_mass(moments: &[RBig]) -> Result<Vec<RBig>, OracleError> {
    let count = moments.len();
    if count == 0 || !count.is_multiple_of(2) {
        return Err(OracleError::MomentCount(count));
    }
    Ok(core::iter::once(RBig::ONE)
        .chain(moments.iter().cloned())
        .collect())
}

/// The points of the only distribution of `rank` points with the given moments: the roots of the monic polynomial of degree
/// `rank` orthogonal to all lower ones. Says apart whether the fragment is one of them.
pub(super) fn unique_support(moments: &[RBig], rank: usize, depth: &RBig) -> (Vec<Real>, bool) {
    let right: Vec<RBig> = moments[rank..2 * rank].iter().map(|b| -b).collect();
    let mut polynomial = solve(hankel(moments, rank), right);
    polynomial.push(RBig::ONE);
    if evaluate(&polynomial, depth).is_zero() {
        (roots(&deflate(&polynomial, depth)), true)
    } else {
        (roots(&polynomial), false)
    }
}

/// The roots of z -> v(depth)^T B^-1 v(z), with v(z) = (1, z, z^2, ..) and the positive definite Hankel matrix B of `size`
/// rows. One at infinity is left out.
pub(super) fn kernel_roots(moments: &[RBig], size: usize, depth: &RBig) -> Vec<Real> {
    let mut power = RBig::ONE;
    let right: Vec<RBig> = (0..size)
        .map(|_| {
            let value = power.clone();
            power = &power * depth;
            value
        })
        .collect();
    let mut kernel = solve(hankel(moments, size), right);
    // A leading coefficient of zero is a root at infinity, of weight zero.
    while kernel.last().is_some_and(RBig::is_zero) {
        kernel.pop();
    }
    roots(&kernel)
}

/// Where an extremal distribution has its points.
pub(super) struct Support {
    /// Points that are neither the fragment nor ends.
    pub(super) roots: Vec<Real>,
    /// Ends of the interval, without the fragment if it is one.
    pub(super) ends: Vec<RBig>,
    /// Whether the fragment depth is a point.
    pub(super) at_fragment: bool,
}

impl Support {
    /// The distribution on these points with b_0, b_1, .. of `moments`. A fragment on an end counts as the fragment.
    pub(super) fn extremal(self, moments: &[RBig], depth: &RBig, unique: bool) -> Extremal {
        let ends: Vec<Real> = self.ends.iter().map(real).collect();
        let depth = real(depth);
        let beside = |position: Real, at_end: bool| {
            let side = position.partial_cmp(&depth).unwrap_or(Ordering::Equal);
            (position, side, at_end)
        };
        let mut positions: Vec<Position> = self
            .roots
            .into_iter()
            .map(|root| beside(root, false))
            .chain(ends.into_iter().map(|end| beside(end, true)))
            .collect();
        if self.at_fragment {
            positions.push((depth, Ordering::Equal, false));
        }
        positions.sort_by(|one, other| one.0.partial_cmp(&other.0).unwrap_or(Ordering::Equal));
        let moments: Vec<Real> = moments.iter().map(real).collect();
        let points: Vec<SupportPoint> = (0..positions.len())
            .map(|index| SupportPoint {
                position: positions[index].0.clone(),
                weight: weight(&moments, &positions, index),
                side: positions[index].1,
                at_end: positions[index].2,
            })
            .collect();
        let share = |counts: fn(Ordering) -> bool| {
            points
                .iter()
                .filter(|point| counts(point.side))
                .fold(real(&RBig::ZERO), |sum, point| sum + &point.weight)
                .to_f64()
                .value()
        };
        Extremal {
            lower: share(Ordering::is_lt),
            upper: share(Ordering::is_le),
            unique,
            points,
        }
    }
}

/// A position, its side of the fragment, and whether it is an end.
type Position = (Real, Ordering, bool);

/// The leading block of the Hankel matrix B_jk = b_(j+k).
fn hankel(moments: &[RBig], size: usize) -> Vec<Vec<RBig>> {
    (0..size)
        .map(|row| moments[row..row + size].to_vec())
        .collect()
}

/// The rank of the Hankel matrix of moments that some distribution has.
pub(super) fn hankel_rank(moments: &[RBig], size: usize) -> Result<usize, OracleError> {
    let mut matrix = hankel(moments, size);
    for step in 0..size {
        let pivot = matrix[step][step].clone();
        if pivot < RBig::ZERO {
            return Err(OracleError::NotMoments);
        }
        if pivot.is_zero() {
            // A distribution of `step` points, if nothing at all is left.
            let nothing_left = matrix[step..]
                .iter()
                .all(|row| row[step..].iter().all(RBig::is_zero));
            return nothing_left.then_some(step).ok_or(OracleError::NotMoments);
        }
        eliminate(&mut matrix, step);
    }
    Ok(size)
}

/// Subtracts multiples of row `step` from those below it, so that their column `step` becomes zero.
fn eliminate(matrix: &mut [Vec<RBig>], step: usize) {
    let (done, rest) = matrix.split_at_mut(step + 1);
    let pivot_row = &done[step];
    for row in rest {
        let factor = &row[step] / &pivot_row[step];
        for (entry, above) in row.iter_mut().zip(pivot_row).skip(step) {
            *entry = &*entry - &factor * above;
        }
    }
}

/// The solution of a linear system with a positive definite matrix.
fn solve(mut matrix: Vec<Vec<RBig>>, right: Vec<RBig>) -> Vec<RBig> {
    let size = right.len();
    for (row, value) in matrix.iter_mut().zip(right) {
        row.push(value);
    }
    for step in 0..size {
        eliminate(&mut matrix, step);
    }
    let mut solution = vec![RBig::ZERO; size];
    for row in (0..size).rev() {
        let known = (row + 1..size).fold(matrix[row][size].clone(), |rest, column| {
            rest - &matrix[row][column] * &solution[column]
        });
        solution[row] = known / &matrix[row][row];
    }
    solution
}

/// The weight of one point: a row of the inverse Vandermonde matrix times the moments, that is the expectation of the
/// Lagrange polynomial that is 1 at this point and 0 at the others.
fn weight(moments: &[Real], positions: &[Position], index: usize) -> Real {
    let at = &positions[index].0;
    let mut basis = vec![real(&RBig::ONE)];
    for (other, (position, ..)) in positions.iter().enumerate() {
        if other == index {
            continue;
        }
        let scale = at - position;
        // basis * (z - position) / (at - position)
        let mut next = vec![real(&RBig::ZERO); basis.len() + 1];
        for (power, coefficient) in basis.iter().enumerate() {
            let coefficient = coefficient / &scale;
            next[power] = &next[power] - &coefficient * position;
            next[power + 1] = &next[power + 1] + coefficient;
        }
        basis = next;
    }
    basis
        .iter()
        .zip(moments)
        .fold(real(&RBig::ZERO), |sum, (coefficient, moment)| {
            sum + coefficient * moment
        })
}
