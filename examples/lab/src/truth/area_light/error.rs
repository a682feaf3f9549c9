//! What can be wrong with an area light.

use super::MOST_PLACES;
use crate::light::LightError;
use crate::truth::peel::PeelError;
use crate::truth::surface::TruthError;

/// Why the shadows of an area light cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AreaLightError {
    /// The light's size or shape.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A mesh of the scene.
    #[error(transparent)]
    Scene(#[from] PeelError),
    /// The picture.
    #[error(transparent)]
    Surface(#[from] TruthError),
    /// Too few or too many places.
    #[error("an area light is sampled at 1 to {MOST_PLACES} places, not at {count}")]
    Places {
        /// What was asked for.
        count: u32,
    },
}
