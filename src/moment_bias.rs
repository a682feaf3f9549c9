//! Moment biases: they make moments valid again that rounding has made invalid.

use serde::{Deserialize, Serialize};

use crate::constant::numbers;
use crate::{Storage, SummedAreaTable};

/// A moment bias: `b + alpha ((0, second, 0, fourth) - b)` (Peters & Klein, i3D 2015, section 3.3).
#[derive(
    Clone, Copy, Debug, PartialEq, Serialize, Deserialize, bytemuck::Pod, bytemuck::Zeroable,
)]
#[repr(C)]
pub struct FourMomentsBias {
    /// The step towards the target, in (0, 1).
    pub alpha: f32,
    /// The second moment of the target; the odd ones are 0.
    pub second: f32,
    /// The fourth moment of the target.
    pub fourth: f32,
}

/// A moment bias of six moments: `b + alpha ((0, even.0, 0, even.1, 0, even.2) - b)`, as the WGSL module `six_moments` has it.
#[derive(
    Clone, Copy, Debug, PartialEq, Serialize, Deserialize, bytemuck::Pod, bytemuck::Zeroable,
)]
#[repr(C)]
pub struct SixMomentsBias {
    /// The second, fourth and sixth moment of the target; the odd ones are 0.
    pub even: [f32; 3],
    /// The step towards the target, in (0, 1).
    pub alpha: f32,
}

const FOUR_MOMENTS: &str = include_str!("../wgsl/moments/four_moments.wgsl");
const HAUSDORFF4: &str = include_str!("../wgsl/bounds/hausdorff4.wgsl");
const SIX_MOMENTS: &str = include_str!("../wgsl/moments/six_moments.wgsl");

/// The bias of this name in a module.
const fn of_four(module: &str, name: &str) -> FourMomentsBias {
    let [alpha, second, fourth] = numbers::<3>(module, name);
    FourMomentsBias {
        alpha: alpha as f32,
        second: second as f32,
        fourth: fourth as f32,
    }
}

/// A bias with the target of another one.
const fn with_alpha(alpha: f32, target: FourMomentsBias) -> FourMomentsBias {
    FourMomentsBias { alpha, ..target }
}

/// The bias of six moments of this name.
const fn of_six(name: &str) -> SixMomentsBias {
    let [second, fourth, sixth] = numbers::<3>(SIX_MOMENTS, "SIX_MOMENTS_BIAS_TARGET");
    let [alpha] = numbers::<1>(SIX_MOMENTS, name);
    SixMomentsBias {
        even: [second as f32, fourth as f32, sixth as f32],
        alpha: alpha as f32,
    }
}

impl Storage {
    /// The smallest moment bias that covers a resolve and a two-pass blur, every stage rounded to the storage. With 8 or 10
    /// bits it leaks so far that no technique stores four moments like that. The bias of float32 relies on sums as exact as
    /// those of the WGSL module `split_sum`, which blurs of any width use then. The bias of a summed-area table depends on
    /// its largest kernel ([`SummedAreaTable::moment_bias`]); here it is that of the largest possible kernel.
    #[must_use]
    pub fn moment_bias(self) -> FourMomentsBias {
        const UNORM16: FourMomentsBias = of_four(FOUR_MOMENTS, "FOUR_MOMENTS_BIAS_UNORM16");
        match self {
            Storage::Unorm8 => with_alpha(1.8e-2, UNORM16),
            Storage::Unorm10 => with_alpha(4.4e-3, UNORM16),
            Storage::Unorm16 => UNORM16,
            Storage::Float16 => const { of_four(FOUR_MOMENTS, "FOUR_MOMENTS_BIAS_FLOAT16") },
            Storage::Float32 => const { of_four(FOUR_MOMENTS, "FOUR_MOMENTS_BIAS_FLOAT32") },
            Storage::Fixed32 => SummedAreaTable::COARSEST.moment_bias(),
        }
    }

    /// The smallest moment bias for distributions on the depth interval (Hausdorff), under the conditions of
    /// [`moment_bias`](Self::moment_bias): their moments lie in a smaller set, so that the target differs and the step is
    /// longer.
    #[must_use]
    pub fn hausdorff_moment_bias(self) -> FourMomentsBias {
        const UNORM16: FourMomentsBias = of_four(HAUSDORFF4, "HAUSDORFF4_BIAS_UNORM16");
        match self {
            Storage::Unorm8 => with_alpha(2.4e-2, UNORM16),
            Storage::Unorm10 => with_alpha(6e-3, UNORM16),
            Storage::Unorm16 => UNORM16,
            Storage::Float16 => const { of_four(HAUSDORFF4, "HAUSDORFF4_BIAS_FLOAT16") },
            Storage::Float32 => const { of_four(HAUSDORFF4, "HAUSDORFF4_BIAS_FLOAT32") },
            Storage::Fixed32 => SummedAreaTable::COARSEST.hausdorff_moment_bias(),
        }
    }

    /// The smallest bias of six moments that covers a resolve and a two-pass blur, every stage rounded to the storage; `None`
    /// for storages that cannot hold six moments. All hold the optimised basis, floats less one half in every channel. The
    /// bias of float32 is what the evaluation in f32 needs rather than the storage, and the bias of unorm10 covers the worst
    /// patches that are known.
    #[must_use]
    pub fn six_moments_bias(self) -> Option<SixMomentsBias> {
        match self {
            Storage::Unorm16 => Some(const { of_six("SIX_MOMENTS_BIAS_UNORM16") }),
            Storage::Float16 => Some(const { of_six("SIX_MOMENTS_BIAS_FLOAT16") }),
            Storage::Float32 => Some(const { of_six("SIX_MOMENTS_BIAS_FLOAT32") }),
            Storage::Unorm10 => Some(const { of_six("SIX_MOMENTS_BIAS_UNORM10") }),
            Storage::Unorm8 | Storage::Fixed32 => None,
        }
    }
}
