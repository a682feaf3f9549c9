//! Fragments at Gauss nodes of biased moments: there the published evaluations divide by what vanishes.

use moment_shadows::{Storage, Technique};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::input::Input;

/// E[z^power] of a mixture.
fn moment(input: &Input, power: i32) -> f64 {
    let surfaces = input.depths.iter().zip(input.weights);
    surfaces
        .map(|(&depth, weight)| f64::from(weight) * f64::from(depth).powi(power))
        .sum()
}

/// The fragment at a node, or up to two units in the last place beside it.
fn at(random: &mut ChaCha8Rng, mut input: Input, node: f64) -> Input {
    if node.is_finite() {
        let beside = f64::from(random.random_range(-2..=2_i32)) * f64::from(f32::EPSILON);
        input.fragment_depth = (node + 0.5 * beside).clamp(-1.0, 1.0) as f32;
    }
    input
}

/// A Gauss node of two points for the moments of the mixture, with one of the biases.
pub(super) fn of_four_moments(input: Input, random: &mut ChaCha8Rng) -> Input {
    let storage = Storage::OF_FOUR_MOMENTS[random.random_range(0..3)];
    let bias = if random.random() {
        storage.moment_bias()
    } else {
        storage.hausdorff_moment_bias()
    };
    // The fourth moment does not determine the nodes.
    let [alpha, second] = [bias.alpha, bias.second].map(f64::from);
    let b: [f64; 3] = [
        (1.0 - alpha) * moment(&input, 1),
        (1.0 - alpha) * moment(&input, 2) + alpha * second,
        (1.0 - alpha) * moment(&input, 3),
    ];
    let variance = b[1] - b[0] * b[0];
    let skew = (b[2] - b[0] * b[1]) / variance - 2.0 * b[0];
    let root = (skew * skew + 4.0 * variance).max(0.0).sqrt();
    let sign = if random.random() { 0.5 } else { -0.5 };
    let node = b[0] + 0.5 * skew + sign * root;
    at(random, input, node)
}

/// A Gauss node of three points for the moments of the mixture, with the bias of a storage of six moments.
pub(super) fn of_six_moments(input: Input, random: &mut ChaCha8Rng) -> Input {
    let storages = Technique::Hamburger6.row().storages;
    let storage = storages[random.random_range(0..storages.len())];
    let which = random.random_range(0..3);
    let Some(bias) = storage.six_moments_bias() else {
        return input;
    };
    let alpha = f64::from(bias.alpha);
    let [second, fourth, _] = bias.even.map(f64::from);
    // The sixth moment does not determine the nodes.
    let target = [0.0, second, 0.0, fourth, 0.0];
    let b: [f64; 5] = core::array::from_fn(|index| {
        (1.0 - alpha) * moment(&input, index as i32 + 1) + alpha * target[index]
    });
    at(random, input, node_of_three(b, which))
}

/// A root of the third orthogonal polynomial of five moments, number `which` from the near end on.
fn node_of_three([b1, b2, b3, b4, b5]: [f64; 5], which: usize) -> f64 {
    let variance = b2 - b1 * b1;
    let covariance = b3 - b1 * b2;
    let slope = covariance / variance;
    let residue = b4 - b2 * b2 - covariance * slope;
    let fourth = b5 - b2 * b3 - covariance * (b4 - b1 * b3) / variance;
    let offset = fourth / residue - slope - b1;
    let second = |x: f64| x * (x - slope + 2.0 * b1) - variance;
    let third = |x: f64| (x - offset) * second(x) - residue / variance * x;
    // The nodes interlace with the roots of the second polynomial; moments of depths in [-1, 1] have no node beyond 3 from their mean.
    let half = 0.5 * (slope - 2.0 * b1);
    let root = (half * half + variance).sqrt();
    let places = [-3.0, half - root, half + root, 3.0];
    let [mut low, mut high] = [places[which], places[which + 1]];
    let sign = third(low) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (third(middle) > 0.0) == sign {
            low = middle;
        } else {
            high = middle;
        }
    }
    b1 + 0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn three_surfaces_are_their_own_nodes() {
        let input = Input {
            depths: [-0.75, 0.25, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
            weights: [0.25, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0],
            ..Input::default()
        };
        let b = core::array::from_fn(|index| moment(&input, index as i32 + 1));
        for (which, depth) in [-0.75, 0.25, 0.5].into_iter().enumerate() {
            // Halving ends at 2^-60; the quotients of moments keep 12 digits here.
            assert!((node_of_three(b, which) - depth).abs() < 1e-12);
        }
    }
}
