//! Filterable shadow maps for any wgpu or WebGPU renderer.

mod file;
mod import;
mod link;
mod link_error;
mod linked;
mod location;
mod module;
mod nearest;
mod profile;
mod token;
#[cfg(feature = "validate")]
mod validate;

pub use import::imports_super;
pub use link::{Source, link, link_module};
pub use link_error::LinkError;
pub use linked::{Linked, Origin};
pub use location::Location;
pub use module::{Module, modules};
pub use profile::Profile;
#[cfg(feature = "validate")]
pub use validate::{
    Backend, Diagnostic, LONGEST_SHADER, Label, Outcome, ValidateError, ValidationReport, validate,
    validate_module,
};
