//! The sharp bounds of shadow intensity over distributions on an interval, for exactly given moments.
//!
//! With m moments, the distribution through the fragment depth that attains both bounds has points whose number, ends of the
//! interval counting one half, is m/2 + 1 (Krein & Nudelman, "The Markov Moment Problem and Extremal Problems", 1977,
//! chapter III). So it consists of the fragment and m/2 other points, or of the fragment, both ends and m/2 - 1 others. The
//! former are the points of the distribution on the real line; that one serves if they lie in the interval. The latter are
//! those of the distribution (z - low)(high - z) dS, whose moments are combinations of the given ones.

use dashu::rational::RBig;

use super::exact::{
    Extremal, OracleError, Support, hankel_rank, kernel_roots, unique_support, with_mass,
};
use super::polynomial::{Real, real};

/// The sharp bounds for moments b_1..b_m (m even) of distributions on `interval` at a fragment of depth `depth`.
///
/// For a fragment outside of the interval the support is left empty.
pub fn hausdorff(
    moments: &[RBig],
    interval: [&RBig; 2],
    depth: &RBig,
) -> Result<Extremal, OracleError> {
    let moments = with_mass(moments)?;
    let [low, high] = interval;
    if low >= high {
        let [low, high] = interval.map(|end| end.to_f64().value());
        return Err(OracleError::EmptyInterval(low, high));
    }
    let size = moments.len() / 2 + 1;
    // Moments of (z - low)(high - z) dS.
    let inner: Vec<RBig> = moments
        .windows(3)
        .map(|b| (low + high) * &b[1] - low * high * &b[0] - &b[2])
        .collect();
    let rank =
        |moments: &[RBig], size| hankel_rank(moments, size).map_err(|_| OracleError::NotOnInterval);
    let (full_rank, inner_rank) = (rank(&moments, size)?, rank(&inner, size - 1)?);
    if depth < low || depth > high {
        let share = f64::from(depth > high);
        return Ok(Extremal {
            lower: share,
            upper: share,
            unique: full_rank < size || inner_rank < size - 1,
            points: Vec::new(),
        });
    }
    let on_end = depth == low || depth == high;
    let other_ends = || -> Vec<RBig> {
        [low, high]
            .into_iter()
            .filter(|&end| end != depth)
            .cloned()
            .collect()
    };
    if full_rank < size {
        let (roots, at_fragment) = unique_support(&moments, full_rank, depth);
        let support = Support {
            roots,
            ends: Vec::new(),
            at_fragment,
        };
        return Ok(support.extremal(&moments, depth, true));
    }
    if inner_rank < size - 1 {
        // Points between the ends, and a distribution of points that are ends or between them.
        let (roots, at_fragment) = unique_support(&inner, inner_rank, depth);
        let support = Support {
            roots,
            ends: other_ends(),
            at_fragment: at_fragment || on_end,
        };
        return Ok(support.extremal(&moments, depth, true));
    }
    let roots = kernel_roots(&moments, size, depth);
    let (first, last) = (real(low), real(high));
    let within = |root: &Real| first <= *root && *root <= last;
    // All of them: one at infinity is outside, too.
    if on_end || (roots.len() == size - 1 && roots.iter().all(within)) {
        let support = Support {
            roots,
            ends: Vec::new(),
            at_fragment: true,
        };
        return Ok(support.extremal(&moments, depth, false));
    }
    let support = Support {
        roots: kernel_roots(&inner, size - 1, depth),
        ends: other_ends(),
        at_fragment: true,
    };
    let extremal = support.extremal(&moments, depth, false);
    let negative = |point: &super::SupportPoint| point.weight < real(&RBig::ZERO);
    if extremal.points.iter().any(negative) {
        return Err(OracleError::NotOnInterval);
    }
    Ok(extremal)
}
