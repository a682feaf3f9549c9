//! The library's nodes. Each is a pair: a declaration here, and thin WGSL entry points beside it.

mod blur_moments;
mod kernel_property;
mod moments_input;
mod resolve_moments;
mod shade_hard;
mod specialization;
mod unrolled;

pub use blur_moments::{BlurMoments, BlurParameters};
pub use kernel_property::KernelProperty;
pub use resolve_moments::ResolveMoments;
pub use shade_hard::{
    CameraView, LightDepth, LightView, ShadeHard, ShadeHardParameters, SingularCamera,
};
