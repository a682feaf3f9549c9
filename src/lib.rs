//! Filterable shadow maps for any wgpu or WebGPU renderer.

mod depth;
mod format;
mod kernel;
mod leak_reduction;
mod profile;
mod receiver_bias;
mod storage;
mod technique;

pub use depth::{DepthConversion, DepthError, DepthRange};
pub use format::{FormatSupport, TextureFormat};
pub use kernel::{Kernel, KernelError, LARGEST_RADIUS};
pub use leak_reduction::{LeakReduction, LeakReductionError};
pub use profile::Profile;
pub use receiver_bias::{ReceiverBias, STANDARD_DEVIATIONS};
pub use storage::{MomentBias, Storage, UnsupportedStorage};
pub use technique::Technique;
