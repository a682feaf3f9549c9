//! Random depth distributions of every regime that a filtered shadow map meets.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Surfaces as (moment depth, weight), and a fragment depth that is interesting for them.
pub(crate) struct Sample {
    pub(crate) atoms: Vec<(f64, f64)>,
    pub(crate) fragment_depth: f64,
    /// The fragment is to be moved to a Gauss node of the biased moments, less this distance.
    pub(crate) from_gauss_node: Option<f64>,
}

pub(crate) const CLASSES: [&str; 10] = [
    "3 to 6 surfaces",
    "2 surfaces far apart",
    "2 surfaces close together",
    "1 surface",
    "fragment on a surface",
    "fragment at a Gauss node",
    "slope",
    "minor weight",
    "fragment at the mean",
    "clamped ends",
];

/// A random sample of a class.
pub(crate) fn sample(class: &str, random: &mut ChaCha8Rng) -> Sample {
    let depth = |random: &mut ChaCha8Rng| random.random_range(-1.0..=1.0_f64);
    let weight = |random: &mut ChaCha8Rng| random.random_range(0.05..=1.0_f64);
    let small = |random: &mut ChaCha8Rng, exponents: core::ops::Range<f64>| {
        10.0_f64.powf(random.random_range(exponents))
    };
    let several = |random: &mut ChaCha8Rng, count: usize| -> Vec<(f64, f64)> {
        (0..count)
            .map(|_| (depth(random), weight(random)))
            .collect()
    };
    let count = random.random_range(3..=6);
    let mut from_gauss_node = None;
    let mut fragment_depth = depth(random);
    let atoms = match class {
        "3 to 6 surfaces" => several(random, count),
        "2 surfaces far apart" => {
            let near = random.random_range(-1.0..=0.9);
            let far = random.random_range(near + 0.1..=1.0);
            vec![(near, weight(random)), (far, weight(random))]
        }
        "2 surfaces close together" => {
            let near = random.random_range(-1.0..=0.9);
            let gap = small(random, -5.0..-1.0);
            if random.random() {
                fragment_depth = near + gap * random.random_range(-10.0..=10.0);
            }
            vec![(near, weight(random)), (near + gap, weight(random))]
        }
        "1 surface" => {
            let surface = depth(random);
            if random.random() {
                let sign = if random.random() { 1.0 } else { -1.0 };
                fragment_depth = surface + sign * small(random, -7.0..0.0);
            }
            vec![(surface, 1.0)]
        }
        "fragment on a surface" => {
            let atoms = several(random, count - 2);
            fragment_depth = atoms[0].0;
            atoms
        }
        "fragment at a Gauss node" => {
            let sign = if random.random() { 1.0 } else { -1.0 };
            from_gauss_node = Some(sign * small(random, -9.0..-5.0));
            several(random, count)
        }
        "slope" => {
            // The 9 rows of a kernel on a plane.
            let middle = depth(random);
            let half_width = small(random, -5.0..-1.0);
            if random.random() {
                fragment_depth = middle + half_width * random.random_range(-3.0..=3.0);
            }
            (-4..=4)
                .map(|row| {
                    let weight = (-0.5 * (f64::from(row) / 2.4).powi(2)).exp();
                    (middle + half_width * f64::from(row) / 4.0, weight)
                })
                .collect()
        }
        "minor weight" => {
            let minor = small(random, -6.0..-3.0);
            vec![(depth(random), 1.0), (depth(random), minor)]
        }
        "fragment at the mean" => {
            // Half of them symmetric to the middle: the odd moments, and with them a coefficient, are 0 exactly.
            let middle = if random.random() { 0.0 } else { depth(random) };
            let distance = random.random_range(0.0..1.0 - f64::abs(middle));
            fragment_depth = middle;
            vec![(middle - distance, 1.0), (middle + distance, 1.0)]
        }
        _ => {
            let mut atoms = several(random, count - 3);
            if random.random() {
                atoms.push((1.0, weight(random)));
            }
            if random.random() || atoms.is_empty() {
                atoms.push((-1.0, weight(random)));
            }
            atoms
        }
    };
    let atoms = atoms
        .into_iter()
        .map(|(depth, weight)| (depth.clamp(-1.0, 1.0), weight))
        .collect();
    Sample {
        atoms,
        fragment_depth: fragment_depth.clamp(-1.0, 1.0),
        from_gauss_node,
    }
}

/// Moments b_1..b_N in f64.
pub(crate) fn moments<const N: usize>(atoms: &[(f64, f64)]) -> [f64; N] {
    let sum: f64 = atoms.iter().map(|atom| atom.1).sum();
    core::array::from_fn(|index| {
        atoms
            .iter()
            .map(|(depth, weight)| weight / sum * depth.powi(index as i32 + 1))
            .sum()
    })
}

/// The moment bias in f64, rounded to f32 once.
pub(crate) fn biased(moments: [f64; 4], alpha: f64, beta: f64) -> [f32; 4] {
    core::array::from_fn(|index| {
        let target = if index % 2 == 1 { beta } else { 0.0 };
        (moments[index] + alpha * (target - moments[index])) as f32
    })
}

/// The lower or upper Gauss node of moments: a root of the second orthogonal polynomial.
pub(crate) fn gauss_node(moments: [f32; 4], upper: bool) -> f64 {
    let [b1, b2, b3, _] = moments.map(f64::from);
    let variance = b2 - b1 * b1;
    let half = 0.5 * ((b3 - b1 * b2) / variance - 2.0 * b1);
    let root = (half * half + variance).sqrt();
    b1 + half + if upper { root } else { -root }
}
