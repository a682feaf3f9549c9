//! Why a shader is not valid under a profile.

use super::{Backend, Diagnostic, LONGEST_SHADER};
use crate::{LinkError, Location};

/// A shader that is not valid under a profile, or that a backend fails to write.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ValidateError {
    /// The text is longer than [`LONGEST_SHADER`].
    #[error(
        "the shader has {bytes} bytes, and at most {LONGEST_SHADER} are validated; split it\n --> {file}"
    )]
    TooLong {
        /// The file's name.
        file: String,
        /// Its length, or that of the linked text.
        bytes: usize,
    },
    /// The text has more of something than [`LONGEST_CHAIN`](super::LONGEST_CHAIN),
    /// [`LONGEST_DEFINITION`](super::LONGEST_DEFINITION), [`LARGEST_CONSTANT`](super::LARGEST_CONSTANT),
    /// [`LARGEST_VALUE`](super::LARGEST_VALUE) or [`MOST_VALUES`](super::MOST_VALUES) allows.
    #[error("more than {limit} {what}; split the shader\n{at}")]
    TooMany {
        /// The limit.
        limit: usize,
        /// What exceeds the limit.
        what: &'static str,
        /// The place where the limit is exceeded.
        at: Box<Location>,
    },
    /// The imports are wrong.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// The text is not WGSL, or uses an extension that the profile does not have.
    #[error("{0}")]
    Parse(Diagnostic),
    /// The text is not a valid shader, or uses a feature that the profile does not have.
    #[error("{0}")]
    Invalid(Diagnostic),
    /// A storage texture has a format or access that the profile does not have.
    #[error("{0}")]
    StorageFormat(Diagnostic),
    /// The WGSL compiler panicked, or no thread could be started for it.
    #[error(
        "the WGSL compiler stopped without a result; cut the shader down to what makes it stop, and report it to naga\n --> {file}"
    )]
    Compiler {
        /// The file's name.
        file: String,
    },
    /// A valid shader that a backend cannot write although it has to.
    #[error("{backend} cannot be written: {message}\n --> {file}")]
    Backend {
        /// The file's name.
        file: String,
        /// The backend.
        backend: Backend,
        /// The backend's message.
        message: String,
    },
}
