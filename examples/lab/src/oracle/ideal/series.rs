//! The Fourier series of convolution shadow maps (Annen et al., "Convolution Shadow Maps", EGSR 2007, section 4), summed over
//! surfaces instead of channels.

use core::f64::consts::PI;

use super::Surfaces;

/// A damped series of the step.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct FourierSeries {
    pub terms: u32,
    pub damping: f64,
    /// How far the receiver moves towards the light for a bound, on an axis that is two shifts shorter than 1.
    pub shift: f64,
    /// What is subtracted for a bound.
    pub overshoot: f64,
    pub is_bound: bool,
}

impl FourierSeries {
    /// The shadow intensity of surfaces at a fragment.
    pub(super) fn of(&self, surfaces: &Surfaces<'_>, fragment_depth: f64) -> f64 {
        let place = |z: f64| (0.5 + 0.5 * z) * (1.0 - 2.0 * self.shift);
        let (moved, lowered) = match self.is_bound {
            true => (self.shift, self.overshoot),
            false => (0.0, 0.0),
        };
        let receiver = place(fragment_depth) - moved;
        let shadow = surfaces.mean(|z| self.step(receiver - place(z)));
        (shadow - lowered).clamp(0.0, 1.0)
    }

    /// About 1 where a surface is `distance` in front of the receiver, 1/2 where it is the receiver.
    fn step(&self, distance: f64) -> f64 {
        let wave = |k: u32| {
            let share = f64::from(k) / f64::from(self.terms);
            let frequency = PI * (2.0 * f64::from(k) - 1.0);
            2.0 * (-self.damping * share * share).exp() / frequency * (frequency * distance).sin()
        };
        0.5 + (1..=self.terms).map(wave).sum::<f64>()
    }
}
