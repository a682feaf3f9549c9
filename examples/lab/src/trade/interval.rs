//! What an error will be from a view that was not judged.

/// Quantiles of Student's t that 90 % of its values lie between, for 1, 2, .. degrees of freedom; beyond them that of the normal
/// distribution is near.
const T: [f64; 20] = [
    6.314, 2.920, 2.353, 2.132, 2.015, 1.943, 1.895, 1.860, 1.833, 1.812, 1.796, 1.782, 1.771,
    1.761, 1.753, 1.746, 1.740, 1.734, 1.729, 1.725,
];
const NORMAL: f64 = 1.645;

/// The interval that the error of another view of the same kind lies in with 90 %, if errors are spread lognormally: views differ by
/// factors. `None` for fewer than two errors, or one that is not above 0.
#[must_use]
pub fn prediction(errors: &[f64]) -> Option<[f64; 2]> {
    let count = errors.len();
    if count < 2
        || errors
            .iter()
            .any(|&error| !(error > 0.0 && error.is_finite()))
    {
        return None;
    }
    let logarithms: Vec<f64> = errors.iter().map(|error| error.ln()).collect();
    let mean = logarithms.iter().sum::<f64>() / count as f64;
    let squares: f64 = logarithms.iter().map(|it| (it - mean).powi(2)).sum();
    let deviation = (squares / (count - 1) as f64).sqrt();
    let quantile = T.get(count - 2).copied().unwrap_or(NORMAL);
    let reach = quantile * deviation * (1.0 + 1.0 / count as f64).sqrt();
    Some([mean - reach, mean + reach].map(f64::exp))
}

#[cfg(test)]
mod tests {
    use super::prediction;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    #[test]
    fn nine_of_ten_further_errors_lie_within() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        // The sum of twelve uniform numbers is nearly normal.
        let mut error = || {
            let sum: f64 = (0..12).map(|_| random.random_range(-0.5..0.5)).sum();
            (-4.0 + 0.5 * sum).exp()
        };
        for count in [2, 4, 8, 30] {
            let trials = 20_000;
            let mut within = 0;
            for _ in 0..trials {
                let errors: Vec<f64> = (0..count).map(|_| error()).collect();
                let Some([low, high]) = prediction(&errors) else {
                    continue;
                };
                within += u32::from((low..=high).contains(&error()));
            }
            let share = f64::from(within) / f64::from(trials);
            // Three deviations of the share are 0.6 %; the normal quantile at 29 degrees is short by 1 %.
            assert!((share - 0.9).abs() < 0.016, "{count}: {share}");
        }
    }

    #[test]
    fn one_error_or_none_tell_nothing() {
        assert_eq!(prediction(&[0.1]), None);
        assert_eq!(prediction(&[0.1, 0.0]), None);
        assert_eq!(prediction(&[]), None);
    }
}
