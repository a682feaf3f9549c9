//! Packed texels of four moments, as the WGSL modules `packed_four_moments` and `storage` have them, in f32.

const STEPS: f32 = 65535.0;

/// The moments of a packed texel for these.
pub(super) fn packed(b: [f32; 4]) -> [f32; 4] {
    let [first, second, third, fourth] = b;
    let mean = first.clamp(-1.0, 1.0);
    let variance = (-mean).mul_add(mean, second).max(0.0);
    let covariance = (-mean).mul_add(second, third);
    let divisor = variance.max(1e-5);
    let beyond = (-second).mul_add(second, fourth);
    let pivot = (-covariance)
        .mul_add(covariance / divisor, beyond)
        .clamp(0.0, 1.0);
    let s = ((-2.0 * mean).mul_add(variance, covariance) / divisor).clamp(-2.0, 2.0);
    let farther = 0.5 * s.abs() + (0.25 * s).mul_add(s, variance).sqrt();
    let nearer = variance / farther.max(1e-20);
    let [below, above] = if s >= 0.0 {
        [nearer, farther]
    } else {
        [farther, nearer]
    };
    let place = |depth: f32| depth.mul_add(0.5, 0.5).clamp(0.0, 1.0) * STEPS;
    let lower = place(mean - below).floor().min(STEPS - 1.0);
    let upper = place(mean + above).ceil().max(lower + 1.0);
    let weight = ((mean.mul_add(0.5, 0.5) * STEPS - lower) / (upper - lower)).clamp(0.0, 1.0);
    let stored = |channel: f32| (channel * STEPS).round() / STEPS;
    let [low, high] = [lower, upper].map(|place| 2.0 * place / STEPS - 1.0);
    let (weight, root) = (stored(weight), stored(pivot.sqrt().sqrt()));
    let mut moments = [1, 2, 3, 4].map(|power| {
        let [low, high] = [low, high].map(|node| node.powi(power));
        weight.mul_add(high - low, low)
    });
    moments[3] += root * root * (root * root);
    moments
}
