//! How moments lie in memory, as far as rounding is concerned.

use half::f16;
use moment_shadows::Storage;

use super::definite::Condition;
use crate::basis::{Quantisation, four_moments, four_moments_of_unit_depth, six_moments};

/// The nearest value that a channel of a storage can hold.
#[must_use]
pub fn rounded(storage: Storage, value: f32) -> f32 {
    match unorm_steps(storage) {
        Some(steps) => (value.clamp(0.0, 1.0) * steps).round() / steps,
        None if storage == Storage::Float16 => f16::from_f32(value).to_f32(),
        None => value,
    }
}

/// The steps of fixed point in [0, 1]; none for floats.
fn unorm_steps(storage: Storage) -> Option<f32> {
    match storage {
        Storage::Unorm8 => Some(255.0),
        Storage::Unorm10 => Some(1023.0),
        Storage::Unorm16 => Some(65535.0),
        _ => None,
    }
}

/// `M` moments in memory, four or six, and the moments towards which a bias moves them.
#[derive(Clone, Debug, PartialEq)]
pub struct Form<const M: usize = 4> {
    /// A short name.
    pub name: String,
    /// The least and the greatest depth.
    pub interval: [f64; 2],
    /// What makes channels of moments, if they are not stored as they are.
    pub(super) basis: Option<Quantisation<M>>,
    /// How channels are rounded.
    pub storage: Storage,
    /// b*.
    pub target: [f64; M],
    /// Which matrices have to be positive definite.
    pub condition: Condition,
}

impl<const M: usize> Form<M> {
    /// The step of the bias for texels that a blur that resolves rounds inwards; none for other forms.
    pub(super) fn inward_bias(&self) -> Option<f64> {
        let is_rounded_inwards = matches!(self.storage, Storage::Unorm16 | Storage::Float16)
            && self.condition == Condition::Line
            && self.name == self.storage.name()
            && M == 4;
        let bias = self.storage.moment_bias_rounded_inwards();
        is_rounded_inwards.then(|| f64::from(bias.alpha))
    }

    /// Moments that are moved towards the target by a step.
    pub(super) fn biased(&self, b: &[f64; M], step: f64) -> [f64; M] {
        core::array::from_fn(|index| b[index] + step * (self.target[index] - b[index]))
    }

    /// The largest error of one rounding of a channel: a float is within one half in a basis, and within 1 otherwise, but
    /// for half precision.
    pub(super) fn error(&self) -> f64 {
        match (unorm_steps(self.storage), &self.basis) {
            (Some(steps), _) => 0.5 / f64::from(steps),
            (None, _) if self.storage == Storage::Float16 => 2.0_f64.powi(-13),
            (None, Some(_)) => 2.0_f64.powi(-26),
            (None, None) => 2.0_f64.powi(-25),
        }
    }
}

/// A basis as a storage of the library holds it: floats less one half.
fn of_storage<const M: usize>(basis: Quantisation<M>, storage: Storage) -> Quantisation<M> {
    match unorm_steps(storage) {
        Some(_) => basis,
        None => basis.shifted(-0.5),
    }
}

const SIGNED: [f64; 2] = [-1.0, 1.0];
const UNIT: [f64; 2] = [0.0, 1.0];

impl Form<6> {
    /// How the library stores six moments of depths in [-1, 1]: all storages hold the optimised basis. None for storages that
    /// six moments cannot have.
    #[must_use]
    pub fn of_six_moments(storage: Storage) -> Option<Self> {
        let [second, fourth, sixth] = storage.six_moments_bias()?.even.map(f64::from);
        Some(Self {
            name: storage.name().to_owned(),
            interval: SIGNED,
            basis: Some(of_storage(six_moments(), storage)),
            storage,
            target: [0.0, second, 0.0, fourth, 0.0, sixth],
            condition: Condition::Line,
        })
    }
}

impl Form {
    /// How the library stores four moments of depths in [-1, 1], with its target for the condition.
    ///
    /// On the real line (0, beta, 0, beta) is optimal with beta = 0.628 for the optimised basis and 0.375 for raw moments
    /// (Peters et al., JCGT 6(1) 2017). These lie on the boundary of the moment space of [-1, 1], so that they cannot help
    /// there; the minimax optimum inside has a smaller fourth moment.
    #[must_use]
    pub fn of_library(storage: Storage, condition: Condition) -> Self {
        let bias = match condition {
            Condition::Line => storage.moment_bias(),
            Condition::Interval => storage.hausdorff_moment_bias(),
        };
        Self {
            name: storage.name().to_owned(),
            interval: SIGNED,
            basis: (storage != Storage::Float32).then(|| of_storage(four_moments(), storage)),
            storage,
            target: [0.0, f64::from(bias.second), 0.0, f64::from(bias.fourth)],
            condition,
        }
    }

    /// What else has been published for four moments: depths in [0, 1], with both of the targets given for these.
    #[must_use]
    pub fn published() -> Vec<Self> {
        let half = [0.5; 4];
        let supplement = core::array::from_fn(|index| 0.8 * 0.5 + 0.2 / (index as f64 + 2.0));
        let form = |name: &str, basis, storage, target| Self {
            name: name.to_owned(),
            interval: UNIT,
            basis,
            storage,
            target,
            condition: Condition::Line,
        };
        let theta = Some(four_moments_of_unit_depth());
        vec![
            form("theta_4, 1/2", theta.clone(), Storage::Unorm16, half),
            form("theta_4, 0.8/0.2", theta, Storage::Unorm16, supplement),
            form("raw [0,1], 1/2", None, Storage::Float32, half),
            form("raw [0,1], 0.8/0.2", None, Storage::Float32, supplement),
            Self {
                interval: SIGNED,
                ..form(
                    "f16, not centred",
                    Some(four_moments()),
                    Storage::Float16,
                    [0.0, 0.628, 0.0, 0.628],
                )
            },
        ]
    }
}
