//! Linear programs: against the exact bounds, and by duality.

use moment_shadows_lab::oracle::{LinearError, MomentProblem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hausdorff, mixtures, normalised};

const SIGNED: [f64; 2] = [-1.0, 1.0];

/// A sample whose surfaces take up a quarter of the depth range: the fourth power of finer clusters is close to rounding.
fn spread_out(class: &str, random: &mut ChaCha8Rng) -> mixtures::Sample {
    loop {
        let sample = mixtures::sample(class, random);
        let depths = || sample.atoms.iter().map(|atom| atom.0);
        let [least, greatest] = [depths().fold(1.0, f64::min), depths().fold(-1.0, f64::max)];
        if greatest - least > 0.5 {
            return sample;
        }
    }
}

/// A grid has fewer distributions than the interval, so that its bounds are weaker, less and less so.
#[test]
fn bounds_approach_the_exact_ones_from_one_side() {
    const EACH: usize = 20;
    // The gaps of other random distributions, found with another solver. The worst of a few hundred cases differs a lot.
    for (count, published) in [
        (2, [1.8e-5, 9.6e-7, 3.9e-8]),
        (4, [3.6e-5, 5.0e-6, 1.4e-7]),
        (6, [1.0e-3, 5.2e-5, 2.8e-6]),
    ] {
        let mut gaps = [0.0_f64; 3];
        for (grid, nodes) in [201, 801, 3201].into_iter().enumerate() {
            let problem = MomentProblem::new(count, SIGNED, nodes).unwrap();
            let mut random = ChaCha8Rng::seed_from_u64(4);
            for class in [
                "3 to 6 surfaces",
                "2 surfaces far apart",
                "fragment on a surface",
                "minor weight",
                "clamped ends",
            ] {
                for _ in 0..EACH {
                    let sample = spread_out(class, &mut random);
                    let depth = sample.fragment_depth;
                    let exact = exact_hausdorff(&sample.atoms, count, SIGNED, depth);
                    let atoms = normalised(&sample.atoms);
                    let lower = problem.lower_of(&atoms, depth).unwrap();
                    let upper = problem.upper_of(&atoms, depth).unwrap();
                    for (gap, own, side) in [
                        (
                            lower.value - exact.lower,
                            lower.value - lower.certificate,
                            "lower",
                        ),
                        (
                            exact.upper - upper.value,
                            upper.certificate - upper.value,
                            "upper",
                        ),
                    ] {
                        assert!(gap >= -1e-9, "{class}, {count} moments, {side}: {gap:e}");
                        // Primal and dual agree: the program was solved. On the boundary of the moment space dual
                        // solutions are unbounded, and their rounding with them.
                        assert!(
                            own.abs() < 1e-6,
                            "{class}, {count} moments, {side}: {own:e}"
                        );
                        // Clusters as fine as the grid are out of its reach.
                        if class == "3 to 6 surfaces" || class == "fragment on a surface" {
                            gaps[grid] = gaps[grid].max(gap);
                        }
                    }
                }
            }
        }
        println!("{count} moments: largest gaps {gaps:?}, published {published:?}");
        assert!(gaps[0] > gaps[1] && gaps[1] > gaps[2]);
        assert!(gaps[2] < 50.0 * published[2], "{gaps:?}");
    }
}

#[test]
fn given_moments_give_what_their_distribution_gives() {
    let problem = MomentProblem::new(4, SIGNED, 401).unwrap();
    // On nodes of the grid, so that the distribution is one of those considered either way.
    let atoms: [(f64, f64); 4] = [(-0.5, 0.25), (0.0, 0.25), (0.25, 0.25), (0.75, 0.25)];
    let moments =
        [1, 2, 3, 4].map(|power| atoms.map(|(z, weight)| weight * z.powi(power)).iter().sum());
    for depth in [-0.9, -0.5, -0.1, 0.3, 0.8] {
        let lower = problem.lower(&moments, depth).unwrap().value;
        let upper = problem.upper(&moments, depth).unwrap().value;
        // Constraints hold to rounding, and the bound's derivatives are moderate here.
        assert!((lower - problem.lower_of(&atoms, depth).unwrap().value).abs() < 1e-10);
        assert!((upper - problem.upper_of(&atoms, depth).unwrap().value).abs() < 1e-10);
        assert!(lower <= upper);
    }
}

/// A bound is never above the truth, and never below that of fewer moments on the same nodes.
#[test]
fn more_moments_tell_more() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let problems =
        [1, 2, 3, 4, 5, 6].map(|count| MomentProblem::new(count, [0.0, 1.0], 201).unwrap());
    for _ in 0..50 {
        let atoms: Vec<(f64, f64)> = (0..4)
            .map(|_| (random.random_range(0.0..1.0), random.random_range(0.1..1.0)))
            .collect();
        let atoms = normalised(&atoms);
        let depth = random.random_range(0.0..1.0);
        let truth: f64 = atoms
            .iter()
            .filter(|atom| atom.0 < depth)
            .map(|atom| atom.1)
            .sum();
        let mut before = 0.0;
        for problem in &problems {
            let value = problem.lower_of(&atoms, depth).unwrap().value;
            // Reduced costs count as zero from 1e-13 times the dual solution on.
            assert!(value >= before - 1e-9 && value <= truth + 1e-9);
            before = value;
        }
    }
}

#[test]
fn what_is_no_program_is_refused() {
    let problem = |powers, nodes| MomentProblem::new(powers, [0.0, 1.0], nodes);
    assert_eq!(problem(2, 3).unwrap_err(), LinearError::TooFewNodes(3));
    // In f64 the powers up to the 21st can be told apart at these nodes.
    assert_eq!(problem(40, 50).unwrap_err(), LinearError::Dependent(22));
    let problem = problem(2, 50).unwrap();
    assert_eq!(
        problem.lower(&[0.5], 0.5).unwrap_err(),
        LinearError::MomentCount {
            given: 1,
            expected: 2
        }
    );
    assert_eq!(
        problem.lower(&[0.5, 0.3], 1.5).unwrap_err(),
        LinearError::Depth(1.5)
    );
    assert!(matches!(
        problem.lower(&[0.5, 0.3], f64::NAN),
        Err(LinearError::Depth(_))
    ));
    // A variance of -0.05.
    let error = problem.lower(&[0.5, 0.2], 0.5).unwrap_err();
    assert!(
        matches!(error, LinearError::Infeasible(miss) if miss > 1e-3),
        "{error}"
    );
    assert!(matches!(
        problem.lower(&[f64::NAN, 0.2], 0.5),
        Err(LinearError::Stuck | LinearError::Infeasible(_))
    ));
    for atoms in [
        vec![],
        vec![(0.5, 0.0)],
        vec![(0.5, -1.0), (0.2, 2.0)],
        vec![(2.0, 1.0)],
        vec![(f64::NAN, 1.0)],
    ] {
        assert_eq!(
            problem.lower_of(&atoms, 0.5).unwrap_err(),
            LinearError::Mixture
        );
    }
}
