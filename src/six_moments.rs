//! The moment bias of six moments.

use serde::{Deserialize, Serialize};

use crate::Storage;

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

impl Storage {
    /// The smallest bias of six moments that covers a resolve and a two-pass blur, every stage rounded to the storage; none
    /// for storages that six moments cannot have. All hold the optimised basis, floats less one half in every channel. That of
    /// float32 is what the evaluation in f32 needs rather than the storage, and that of unorm10 covers the worst patches that are known.
    #[must_use]
    pub fn six_moments_bias(self) -> Option<SixMomentsBias> {
        let alpha = match self {
            Storage::Unorm16 => 1e-4,
            Storage::Float16 => 1.5e-3,
            Storage::Float32 => 1e-5,
            Storage::Unorm10 => 6.5e-3,
            Storage::Unorm8 | Storage::Fixed32 => return None,
        };
        Some(SixMomentsBias {
            even: [0.5566, 0.489, 0.478_693_8],
            alpha,
        })
    }
}
