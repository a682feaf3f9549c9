//! Surfaces under a filter, with what a moment bias adds to them.

/// Depths with their weights, and further surfaces that a bias adds.
#[derive(Clone, Copy)]
pub(super) struct Surfaces<'a> {
    /// Moment depths in [-1, 1].
    pub depths: &'a [f64],
    /// Not negative, with the sum 1, as many as depths.
    pub weights: &'a [f64],
    /// Depths and weights that are mixed in.
    pub added: &'a [[f64; 2]],
}

impl Surfaces<'_> {
    /// The mean of a function of depth.
    pub(super) fn mean(&self, value: impl Fn(f64) -> f64) -> f64 {
        let added = self.added.iter().map(|[_, weight]| weight).sum::<f64>();
        let own: f64 = (self.depths.iter().zip(self.weights))
            .map(|(&z, weight)| weight * value(z))
            .sum();
        let biased = self.added.iter().map(|&[z, weight]| weight * value(z));
        (1.0 - added) * own + biased.sum::<f64>()
    }

    /// The least share in front of the fragment that mean and variance of a rising function of depth allow which is 0 at the
    /// fragment (Cantelli's inequality), where the variance is at least `smallest` for the function's mean square.
    pub(super) fn cantelli(
        &self,
        function: impl Fn(f64) -> f64,
        smallest: impl Fn(f64) -> f64,
    ) -> f64 {
        let mean = self.mean(&function);
        if mean >= 0.0 {
            return 0.0;
        }
        let variance = self.mean(|z| (function(z) - mean).powi(2));
        let variance = variance.max(smallest(self.mean(|z| function(z).powi(2))));
        if variance.is_finite() && mean.is_finite() {
            // Neither square may overflow.
            1.0 / (1.0 + variance / mean / mean)
        } else {
            0.0
        }
    }
}
