//! Filterable shadow maps for any wgpu or WebGPU renderer.

mod depth;
mod file;
mod format;
mod import;
mod kernel;
mod leak_reduction;
mod link;
mod link_error;
mod linked;
mod location;
mod module;
mod nearest;
mod profile;
mod receiver_bias;
mod storage;
mod technique;
mod token;
#[cfg(feature = "validate")]
mod validate;

pub use depth::{DepthConversion, DepthError, DepthRange};
pub use format::{FormatSupport, TextureFormat};
pub use import::imports_super;
pub use kernel::{Kernel, KernelError, LARGEST_RADIUS};
pub use leak_reduction::{LeakReduction, LeakReductionError};
pub use link::{Source, link, link_module};
pub use link_error::LinkError;
pub use linked::{Linked, Origin};
pub use location::Location;
pub use module::{Module, modules};
pub use nearest::nearest;
pub use profile::Profile;
pub use receiver_bias::{ReceiverBias, STANDARD_DEVIATIONS};
pub use storage::{MomentBias, Storage, UnsupportedStorage};
pub use technique::Technique;
#[cfg(feature = "validate")]
pub use validate::{
    Backend, Diagnostic, LONGEST_SHADER, Label, Outcome, ValidateError, ValidationReport, validate,
    validate_module,
};
