//! The oracle is judged: exact bounds against each other and the truth, and what rests on them.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod absorbance;
mod bases;
mod bias;
mod hausdorff;
mod ideal;
mod orderings;
mod six;

// Random distributions of every regime; the shader's tests use the rest of it.
#[allow(dead_code)]
#[path = "../numerics/mixtures.rs"]
mod mixtures;

use moment_shadows_lab::oracle::{Extremal, Mixture, hamburger, hausdorff, rational};

fn exact_hamburger(atoms: &[(f64, f64)], count: usize, depth: f64) -> Extremal {
    let moments = Mixture::new(atoms).unwrap().moments(count);
    hamburger(&moments, &rational(depth).unwrap()).unwrap()
}

fn exact_hausdorff(atoms: &[(f64, f64)], count: usize, interval: [f64; 2], depth: f64) -> Extremal {
    let moments = Mixture::new(atoms).unwrap().moments(count);
    let [low, high] = interval.map(|end| rational(end).unwrap());
    hausdorff(&moments, [&low, &high], &rational(depth).unwrap()).unwrap()
}
