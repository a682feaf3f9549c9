//! Moment biases: they make moments valid again that rounding has made invalid.

use serde::{Deserialize, Serialize};

use crate::constants::*;
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

/// The factor of a bias where so many translucent casters were blended over each other into the map.
fn growth(blends: u32) -> f32 {
    let blends = blends.min(TRANSLUCENT_CASTERS_MOST_BLENDS) as f32;
    1.0 + TRANSLUCENT_CASTERS_BIAS_PER_ROOT * blends.sqrt()
        + TRANSLUCENT_CASTERS_BIAS_PER_BLEND * blends
}

impl FourMomentsBias {
    /// The same for a map that up to so many translucent casters are blended into over each other: `translucent_casters_four_moments_bias`.
    #[must_use]
    pub fn with_blends(self, blends: u32) -> Self {
        with_alpha(self.alpha * growth(blends), self)
    }
}

impl SixMomentsBias {
    /// The same for a map that up to so many translucent casters are blended into over each other: `translucent_casters_six_moments_bias`.
    #[must_use]
    pub fn with_blends(self, blends: u32) -> Self {
        let alpha = self.alpha * growth(blends);
        Self { alpha, ..self }
    }
}

const fn of_four([alpha, second, fourth]: [f32; 3]) -> FourMomentsBias {
    FourMomentsBias {
        alpha,
        second,
        fourth,
    }
}

/// A bias with the target of another one.
const fn with_alpha(alpha: f32, target: FourMomentsBias) -> FourMomentsBias {
    FourMomentsBias { alpha, ..target }
}

impl Storage {
    /// The smallest moment bias that covers a resolve and a two-pass blur, every stage rounded to the storage. With 8 or 10
    /// bits it leaks so far that no technique stores four moments like that. The bias of float32 relies on sums as exact as
    /// those of the WGSL module `split_sum`, which blurs of any width use then. The bias of a summed-area table depends on
    /// its largest kernel ([`SummedAreaTable::moment_bias`]); here it is that of the largest possible kernel.
    #[must_use]
    pub fn moment_bias(self) -> FourMomentsBias {
        const UNORM16: FourMomentsBias = of_four(FOUR_MOMENTS_BIAS_UNORM16);
        match self {
            Storage::Unorm8 => with_alpha(1.8e-2, UNORM16),
            Storage::Unorm10 => with_alpha(4.4e-3, UNORM16),
            Storage::Unorm16 => UNORM16,
            Storage::Float16 => of_four(FOUR_MOMENTS_BIAS_FLOAT16),
            Storage::Float32 => of_four(FOUR_MOMENTS_BIAS_FLOAT32),
            Storage::Packed64 => of_four(FOUR_MOMENTS_BIAS_PACKED64),
            Storage::Packed32 => of_four(FOUR_MOMENTS_BIAS_PACKED32),
            Storage::Fixed32 => SummedAreaTable::COARSEST.moment_bias(),
        }
    }

    /// The smallest moment bias for distributions on the depth interval (Hausdorff), under the conditions of
    /// [`moment_bias`](Self::moment_bias): their moments lie in a smaller set, so that the target differs and the step is
    /// longer.
    #[must_use]
    pub fn hausdorff_moment_bias(self) -> FourMomentsBias {
        const UNORM16: FourMomentsBias = of_four(HAUSDORFF4_BIAS_UNORM16);
        match self {
            Storage::Unorm8 => with_alpha(2.4e-2, UNORM16),
            Storage::Unorm10 => with_alpha(6e-3, UNORM16),
            Storage::Unorm16 => UNORM16,
            Storage::Float16 => of_four(HAUSDORFF4_BIAS_FLOAT16),
            Storage::Float32 => of_four(HAUSDORFF4_BIAS_FLOAT32),
            Storage::Fixed32 => SummedAreaTable::COARSEST.hausdorff_moment_bias(),
            // No technique on the interval reads these, since texels are valid on the real line alone: as float32.
            Storage::Packed64 | Storage::Packed32 => of_four(HAUSDORFF4_BIAS_FLOAT32),
        }
    }

    /// [`moment_bias`](Self::moment_bias) of a map whose texels are rounded inwards ([`crate::MapEncoding::rounded_inwards`]). Smaller for
    /// `unorm16` and `float16`; no others are made so.
    #[must_use]
    pub fn moment_bias_rounded_inwards(self) -> FourMomentsBias {
        match self {
            Storage::Unorm16 => of_four(FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16),
            Storage::Float16 => of_four(FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16),
            Storage::Float32
            | Storage::Unorm8
            | Storage::Unorm10
            | Storage::Fixed32
            | Storage::Packed64
            | Storage::Packed32 => self.moment_bias(),
        }
    }

    /// The smallest bias of six moments that covers a resolve and a two-pass blur, every stage rounded to the storage; `None`
    /// for storages that cannot hold six moments through that many roundings. All hold the optimised basis, floats less one half in every channel. The
    /// bias of float32 is what the evaluation in f32 needs rather than the storage, and the bias of unorm10 covers the worst
    /// patches that are known.
    #[must_use]
    pub fn six_moments_bias(self) -> Option<SixMomentsBias> {
        let [alpha] = match self {
            Storage::Unorm16 => SIX_MOMENTS_BIAS_UNORM16,
            Storage::Float16 => SIX_MOMENTS_BIAS_FLOAT16,
            Storage::Float32 => SIX_MOMENTS_BIAS_FLOAT32,
            Storage::Unorm10 => SIX_MOMENTS_BIAS_UNORM10,
            Storage::Unorm8 | Storage::Fixed32 | Storage::Packed64 | Storage::Packed32 => {
                return None;
            }
        };
        let even = SIX_MOMENTS_BIAS_TARGET;
        Some(SixMomentsBias { even, alpha })
    }
}
