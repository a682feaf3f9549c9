//! What an error will be from a view that was not judged.
//!
//! Views of a scene differ by factors: logarithms of their errors are spread about normally. Few views say little of how far they are
//! spread, but scenes are much alike in that. So what the views of one scene say is weighed with what those of many scenes did, as if
//! the latter were some more views: the usual posterior of a normal distribution whose variance has an inverse chi-squared prior.

/// Errors below this share of full shadow are the same to any eye, and not the factors that they would be apart.
pub const LEAST: f64 = 1e-4;

/// The standard deviation of logarithms of errors among views of a scene: about the middle of eight scenes, which have 0.35 to 0.86.
const USUAL: f64 = 0.55;

/// As many degrees of freedom as that is worth.
const WORTH: f64 = 4.0;

/// The interval that the error of another view of the same kind lies in with 90 %. `None` for fewer than two errors, or one that is
/// none.
#[must_use]
pub fn prediction(errors: &[f64]) -> Option<[f64; 2]> {
    let count = errors.len() as f64;
    if errors.len() < 2
        || !errors
            .iter()
            .all(|&error| error >= 0.0 && error.is_finite())
    {
        return None;
    }
    let logarithms = || errors.iter().map(|error| (error + LEAST).ln());
    let mean = logarithms().sum::<f64>() / count;
    let squares: f64 = logarithms().map(|it| (it - mean).powi(2)).sum();
    let freedom = count - 1.0 + WORTH;
    let variance = (squares + WORTH * USUAL * USUAL) / freedom;
    let reach = quantile(freedom) * (variance * (1.0 + 1.0 / count)).sqrt();
    Some([mean - reach, mean + reach].map(|end| (end.exp() - LEAST).max(0.0)))
}

/// The factor between the ends of an interval.
#[must_use]
pub fn width([low, high]: [f64; 2]) -> f64 {
    (high + LEAST) / (low + LEAST)
}

/// The quantile of Student's t that 90 % of its values are nearer to 0 than, from that of the normal distribution: to half a percent
/// from 5 degrees of freedom on.
fn quantile(freedom: f64) -> f64 {
    const NORMAL: f64 = 1.644_853_626_951_472_2;
    let [one, three, five] = [1, 3, 5].map(|power| NORMAL.powi(power));
    let first = (three + one) / 4.0;
    let second = (5.0 * five + 16.0 * three + 3.0 * one) / 96.0;
    one + first / freedom + second / freedom.powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// The sum of twelve uniform numbers is nearly normal.
    fn normal(random: &mut ChaCha8Rng) -> f64 {
        (0..12).map(|_| random.random_range(-0.5..0.5)).sum()
    }

    /// How many further errors lie within, where scenes differ in their deviation as `deviation` has it.
    fn covered(count: usize, mut deviation: impl FnMut(&mut ChaCha8Rng) -> f64) -> f64 {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        let trials = 20_000;
        let mut within = 0;
        for _ in 0..trials {
            let deviation = deviation(&mut random);
            let mut error = || (-4.0 + deviation * normal(&mut random)).exp();
            let errors: Vec<f64> = (0..count).map(|_| error()).collect();
            let interval = prediction(&errors);
            within +=
                u32::from(interval.is_some_and(|[low, high]| (low..=high).contains(&error())));
        }
        f64::from(within) / f64::from(trials)
    }

    #[test]
    fn nine_of_ten_further_errors_lie_within() {
        for count in [2, 4, 8, 30] {
            let share = covered(count, |random| {
                let squares: f64 = (0..WORTH as u32).map(|_| normal(random).powi(2)).sum();
                USUAL * (WORTH / squares).sqrt()
            });
            // Three deviations of the share are 0.6 %.
            assert!((share - 0.9).abs() < 0.01, "{count}: {share}");
        }
        // Where all views are spread twice as far as usual, four of them make up for little more than half of it.
        let share = covered(4, |_| 2.0 * USUAL);
        assert!(share > 0.78, "{share}");
    }

    #[test]
    fn views_without_an_error_are_as_good_as_those_with_the_least() {
        let [low, high] = prediction(&[0.0, 0.0, 0.0, 0.0]).unwrap_or_default();
        assert!(low == 0.0 && high > LEAST && high < 3.0 * LEAST, "{high}");
        let factor = width([low, high]);
        assert!((factor - (high + LEAST) / LEAST).abs() < 1e-12, "{factor}");
    }

    #[test]
    fn one_error_or_none_tell_nothing() {
        assert_eq!(prediction(&[0.1]), None);
        assert_eq!(prediction(&[0.1, f64::NAN]), None);
        assert_eq!(prediction(&[]), None);
    }
}
