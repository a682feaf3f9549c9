//! How bounds compare on identical moments.

use moment_shadows_lab::oracle::{Mixture, hamburger, rational};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::{exact_hamburger, exact_hausdorff, mixtures};

#[test]
fn hausdorff_is_never_looser_than_hamburger_nor_that_than_variance() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let mut tighter = 0;
    for class in mixtures::CLASSES {
        for _ in 0..60 {
            let sample = mixtures::sample(class, &mut random);
            let (atoms, depth) = (&sample.atoms, sample.fragment_depth);
            let variance = exact_hamburger(atoms, 2, depth);
            let line = exact_hamburger(atoms, 4, depth);
            let interval = exact_hausdorff(atoms, 4, [-1.0, 1.0], depth);
            let six = exact_hausdorff(atoms, 6, [-1.0, 1.0], depth);
            // Exact bounds, rounded once.
            assert!(variance.lower <= line.lower + 1e-15, "{class}");
            assert!(line.lower <= interval.lower + 1e-15, "{class}");
            assert!(interval.lower <= six.lower + 1e-15, "{class}");
            assert!(variance.upper >= line.upper - 1e-15, "{class}");
            assert!(line.upper >= interval.upper - 1e-15, "{class}");
            assert!(interval.upper >= six.upper - 1e-15, "{class}");
            tighter += usize::from(interval.lower > line.lower + 1e-3);
        }
    }
    // It is worth something.
    assert!(tighter > 30, "{tighter}");
}

/// Near and far planes may be 1 to 100 times as far: moments of affinely mapped depths are other numbers, but the bound of
/// exact moments is the same to the last bit.
#[test]
fn near_and_far_planes_do_not_matter_to_power_moments() {
    let mut random = ChaCha8Rng::seed_from_u64(16);
    for class in mixtures::CLASSES {
        for _ in 0..5 {
            let sample = mixtures::sample(class, &mut random);
            let moments = Mixture::new(&sample.atoms).unwrap().moments(4);
            let depth = rational(sample.fragment_depth).unwrap();
            let reference = hamburger(&moments, &depth).unwrap();
            for scale in [1.0, 2.0, 3.0, 7.5, 10.0, 33.0, 100.0] {
                // z -> z / scale + offset, exactly: the moments by the binomial theorem.
                for offset in [0.0, -0.9 + 0.9 / scale] {
                    let factor = rational(1.0).unwrap() / rational(scale).unwrap();
                    let offset = rational(offset).unwrap();
                    let [b1, b2, b3, b4] = [0, 1, 2, 3].map(|index| {
                        (0..=index).fold(moments[index].clone(), |moment, _| moment * &factor)
                    });
                    let [two, three, four, six] =
                        [2.0, 3.0, 4.0, 6.0].map(|value| rational(value).unwrap());
                    let o = &offset;
                    let square = o * o;
                    let mapped = [
                        &b1 + o,
                        &b2 + &two * o * &b1 + &square,
                        &b3 + &three * o * &b2 + &three * &square * &b1 + &square * o,
                        &b4 + &four * o * &b3
                            + &six * &square * &b2
                            + &four * &square * o * &b1
                            + &square * &square,
                    ];
                    let bound = hamburger(&mapped, &(&depth * &factor + o)).unwrap();
                    assert_eq!(
                        [bound.lower, bound.upper],
                        [reference.lower, reference.upper],
                        "{class}, {scale}"
                    );
                }
            }
        }
    }
}
