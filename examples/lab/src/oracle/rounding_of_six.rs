//! The experiment on rounding with six moments instead of four.

use super::Fma;

/// The factorised Hankel matrix of six moments, and how its values are combined.
struct Factor {
    fma: Fma,
    variance: f32,
    ratio: f32,
    shift: f32,
    offset: f32,
    inverse_norms: [f32; 3],
}

/// P1 to P3, these over their squared norms, and the Christoffel number.
struct Polynomials {
    values: [f32; 3],
    coefficients: [f32; 3],
    weight: f32,
}

impl Factor {
    fn new([b1, b2, b3, b4, b5, b6]: [f32; 6], alpha: f32, fma: Fma) -> Self {
        let f = |a, b, c| fma.apply(a, b, c);
        let variance = f(-b1, b1, b2).max(0.03 * alpha);
        let covariance = f(-b1, b2, b3);
        let slope = covariance / variance;
        let residue = f(-covariance, slope, f(-b2, b2, b4)).max(0.02 * alpha);
        let shift = f(-2.0, b1, slope).clamp(-8.0, 8.0);
        let ratio = (residue / variance).min(4.0);
        let residue = residue.min(4.0 * variance);
        let third = f(-b1, b3, b4);
        let third_slope = third / variance;
        let fourth = f(-f(-b1, b2, b3), third_slope, f(-b2, b3, b5));
        let fourth_slope = fourth / residue;
        let pivot = f(
            -fourth,
            fourth_slope,
            f(-third, third_slope, f(-b3, b3, b6)),
        );
        Self {
            fma,
            variance,
            ratio,
            shift,
            offset: f(-3.0, b1, fourth_slope - shift).clamp(-8.0, 8.0),
            inverse_norms: [variance, residue, pivot.max(0.004 * alpha)].map(|norm| 1.0 / norm),
        }
    }

    fn polynomials(&self, x: f32) -> Polynomials {
        let f = |a, b, c| self.fma.apply(a, b, c);
        let second = f(x, x - self.shift, -self.variance);
        let values = [x, second, f(x - self.offset, second, -self.ratio * x)];
        let coefficients = core::array::from_fn(|k| values[k] * self.inverse_norms[k]);
        let sum = (0..3).fold(0.0, |sum, k| f(values[k], coefficients[k], sum));
        Polynomials {
            values,
            coefficients,
            weight: 1.0 / (1.0 + sum),
        }
    }

    fn lone_weight(&self, x: f32, fragment: &Polynomials, side: f32, alpha: f32) -> f32 {
        let f = |a, b, c| self.fma.apply(a, b, c);
        let [k1, k2, k3] = fragment.coefficients;
        let second = f(-k3, self.shift + self.offset, k2);
        let product = f(self.offset, self.shift, -self.variance - self.ratio);
        let first = f(-k2, self.shift, f(k3, product, k1));
        let e2 = side * fragment.weight * f(x, f(3.0 * k3, x, 2.0 * second), first);
        let e1 = fragment.weight * f(3.0 * k3, x, second);
        let e0 = side * fragment.weight * k3;
        let nearest = -1e-4_f32;
        let start = f(e2, e2, -3.0 * e1).max(0.0).sqrt();
        let mut y = (-(e2 + 2.0 * start) / 3.0).min(nearest);
        for _ in 0..if alpha >= 1e-3 { 4 } else { 6 } {
            let value = f(f(y + e2, y, e1), y, e0);
            let slope = f(f(3.0, y, 2.0 * e2), y, e1);
            let curvature = f(6.0, y, 2.0 * e2);
            let root = f(4.0 * slope, slope, -6.0 * value * curvature)
                .max(0.0)
                .sqrt();
            y = (y - 3.0 * value / (slope + root).max(1e-9)).min(nearest);
        }
        self.polynomials(f(side, 1.0 / y, x)).weight
    }
}

/// The (lower, upper) bounds for six moments biased by `alpha`, as f32 arithmetic gives them.
#[must_use]
pub fn six_bounds_in_f32(biased: [f32; 6], fragment_depth: f32, alpha: f32, fma: Fma) -> [f32; 2] {
    let factor = Factor::new(biased, alpha, fma);
    let x = fragment_depth.clamp(-1e4, 1e4) - biased[0];
    let fragment = factor.polynomials(x);
    let positive = [1.0]
        .into_iter()
        .chain(fragment.values)
        .map(|value| value >= 0.0)
        .collect::<Vec<bool>>();
    let below = positive
        .windows(2)
        .filter(|pair| pair[0] == pair[1])
        .count();
    let own = fragment.weight;
    let lone = |side| factor.lone_weight(x, &fragment, side, alpha);
    let bounds = match below {
        0 => [0.0, own],
        1 => {
            let weight = lone(1.0);
            [weight, weight + own]
        }
        2 => {
            let weight = lone(-1.0);
            [1.0 - (weight + own), 1.0 - weight]
        }
        _ => [1.0 - own, 1.0],
    };
    bounds.map(|bound| bound.clamp(0.0, 1.0))
}
