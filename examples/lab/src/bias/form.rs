//! How moments lie in memory, as far as rounding is concerned.

use half::f16;
use moment_shadows::Storage;

use super::definite::Condition;
use crate::basis::published_quantisations;

/// Rounding to the nearest value that a channel can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rounding {
    /// Fixed point in [0, 1] with 2^8 - 1 steps.
    Unorm8,
    /// Fixed point in [0, 1] with 2^10 - 1 steps.
    Unorm10,
    /// Fixed point in [0, 1] with 2^16 - 1 steps.
    Unorm16,
    /// Half precision.
    Float16,
    /// Single precision.
    Float32,
}

impl Rounding {
    /// The value that is stored.
    #[must_use]
    pub fn store(self, value: f32) -> f32 {
        match self {
            Rounding::Unorm8 => (value.clamp(0.0, 1.0) * 255.0).round() / 255.0,
            Rounding::Unorm10 => (value.clamp(0.0, 1.0) * 1023.0).round() / 1023.0,
            Rounding::Unorm16 => (value.clamp(0.0, 1.0) * 65535.0).round() / 65535.0,
            Rounding::Float16 => f16::from_f32(value).to_f32(),
            Rounding::Float32 => value,
        }
    }

    /// The largest error of one rounding: of a channel in [-1/2, 1/2] in half precision, and of one in [-1, 1] otherwise.
    #[must_use]
    pub fn error(self) -> f64 {
        match self {
            Rounding::Unorm8 => 0.5 / 255.0,
            Rounding::Unorm10 => 0.5 / 1023.0,
            Rounding::Unorm16 => 0.5 / 65535.0,
            Rounding::Float16 => 2.0_f64.powi(-13),
            Rounding::Float32 => 2.0_f64.powi(-25),
        }
    }
}

impl From<Storage> for Rounding {
    fn from(storage: Storage) -> Self {
        match storage {
            Storage::Unorm8 => Rounding::Unorm8,
            Storage::Unorm10 => Rounding::Unorm10,
            Storage::Unorm16 => Rounding::Unorm16,
            Storage::Float16 => Rounding::Float16,
            _ => Rounding::Float32,
        }
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
    pub(super) basis: Option<Affine<M>>,
    /// How channels are rounded.
    pub rounding: Rounding,
    /// b*.
    pub target: [f64; M],
    /// Which matrices have to be positive definite.
    pub condition: Condition,
}

/// An affine map and its inverse.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Affine<const M: usize> {
    matrix: [[f64; M]; M],
    offset: [f64; M],
    inverse: [[f64; M]; M],
}

impl<const M: usize> Form<M> {
    /// The largest error of one rounding of a channel.
    pub(super) fn error(&self) -> f64 {
        match (self.rounding, &self.basis) {
            // Within one half, where numbers lie twice as close.
            (Rounding::Float32, Some(_)) => 0.5 * self.rounding.error(),
            _ => self.rounding.error(),
        }
    }
}

impl<const M: usize> Affine<M> {
    /// The published optimised basis for an interval, with `shift` added to each channel.
    pub(super) fn published(interval: [f64; 2], shift: f64) -> Option<Self> {
        let all = published_quantisations();
        let basis = all
            .iter()
            .find(|basis| basis.count() == M && basis.interval == interval)?;
        let square = |rows: &[Vec<f64>]| -> [[f64; M]; M] {
            core::array::from_fn(|row| core::array::from_fn(|column| rows[row][column]))
        };
        Some(Self {
            matrix: square(&basis.matrix),
            offset: core::array::from_fn(|row| basis.offset[row] + shift),
            inverse: square(&basis.inverse),
        })
    }

    pub(super) fn encode(&self, moments: [f64; M]) -> [f64; M] {
        core::array::from_fn(|row| dot(&self.matrix[row], &moments) + self.offset[row])
    }

    pub(super) fn decode(&self, channels: [f64; M]) -> [f64; M] {
        let centred = core::array::from_fn(|row| channels[row] - self.offset[row]);
        self.inverse.map(|row| dot(&row, &centred))
    }

    /// The gradient with respect to the channels of a linear function of the moments.
    pub(super) fn gradient(&self, of_moments: [f64; M]) -> [f64; M] {
        core::array::from_fn(|channel| {
            (0..M)
                .map(|moment| self.inverse[moment][channel] * of_moments[moment])
                .sum()
        })
    }
}

fn dot<const M: usize>(one: &[f64; M], other: &[f64; M]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}

const SIGNED: [f64; 2] = [-1.0, 1.0];
const UNIT: [f64; 2] = [0.0, 1.0];

impl Form<6> {
    /// How the library stores six moments of depths in [-1, 1]: all storages hold the optimised basis, floats less one half. None
    /// for storages that six moments cannot have.
    #[must_use]
    pub fn of_six_moments(storage: Storage) -> Option<Self> {
        let bias = storage.six_moments_bias()?;
        let rounding = Rounding::from(storage);
        let shift = match rounding {
            Rounding::Float16 | Rounding::Float32 => -0.5,
            _ => 0.0,
        };
        let [second, fourth, sixth] = bias.even.map(f64::from);
        Some(Self {
            name: storage.name().to_owned(),
            interval: SIGNED,
            basis: Some(Affine::published(SIGNED, shift)?),
            rounding,
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
        let rounding = Rounding::from(storage);
        let basis = match rounding {
            Rounding::Unorm8 | Rounding::Unorm10 | Rounding::Unorm16 => {
                Affine::published(SIGNED, 0.0)
            }
            Rounding::Float16 => Affine::published(SIGNED, -0.5),
            Rounding::Float32 => None,
        };
        let bias = match condition {
            Condition::Line => storage.moment_bias(),
            Condition::Interval => storage.hausdorff_moment_bias(),
        };
        Self {
            name: storage.name().to_owned(),
            interval: SIGNED,
            basis,
            rounding,
            target: [0.0, f64::from(bias.second), 0.0, f64::from(bias.fourth)],
            condition,
        }
    }

    /// What else has been published for four moments: depths in [0, 1], with both of the targets given for these.
    #[must_use]
    pub fn published() -> Vec<Self> {
        let half = [0.5; 4];
        let supplement = core::array::from_fn(|index| 0.8 * 0.5 + 0.2 / (index as f64 + 2.0));
        let form = |name: &str, interval, rounding, optimised: bool, target| Self {
            name: name.to_owned(),
            interval,
            basis: if optimised {
                Affine::published(interval, 0.0)
            } else {
                None
            },
            rounding,
            target,
            condition: Condition::Line,
        };
        vec![
            form("theta_4, 1/2", UNIT, Rounding::Unorm16, true, half),
            form(
                "theta_4, 0.8/0.2",
                UNIT,
                Rounding::Unorm16,
                true,
                supplement,
            ),
            form("raw [0,1], 1/2", UNIT, Rounding::Float32, false, half),
            form(
                "raw [0,1], 0.8/0.2",
                UNIT,
                Rounding::Float32,
                false,
                supplement,
            ),
            form(
                "f16, not centred",
                SIGNED,
                Rounding::Float16,
                true,
                [0.0, 0.628, 0.0, 0.628],
            ),
        ]
    }
}
