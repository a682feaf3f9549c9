//! What no truth can be computed of.

use super::area_light::MOST_PLACES;
use crate::light::LightError;

/// Why no truth can be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// A list does not have one entry per pixel or sample.
    #[error("{what} has {found} entries where its size asks for {expected}")]
    Length {
        /// What the list holds.
        what: &'static str,
        /// How many entries it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
    /// Only the standard sample patterns have known positions.
    #[error("a depth map of {samples} samples per texel has no standard pattern; use 1, 2, 4 or 8")]
    Samples {
        /// The sample count.
        samples: u32,
    },
    /// A map has no texel to look up, and no rays.
    #[error("a map of {}x{} texels is empty; give it at least one texel each way", size[0], size[1])]
    Empty {
        /// Width and height in texels.
        size: [u32; 2],
    },
    /// A mesh breaks what a scene promises.
    #[error("mesh {mesh} of scene '{scene}' {reason}; load the scene from a valid file")]
    Mesh {
        /// The scene's name.
        scene: String,
        /// The mesh's index.
        mesh: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// Nothing casts a shadow.
    #[error(
        "no ray of the light meets a caster of scene '{scene}' at the texels' centres of a map of {}x{}; \
         use a larger map or another light", map[0], map[1]
    )]
    NoCaster {
        /// The scene's name.
        scene: String,
        /// Width and height in texels.
        map: [u32; 2],
    },
    /// An area light's size or shape.
    #[error(transparent)]
    Light(#[from] LightError),
    /// Too few or too many places on an area light.
    #[error("an area light is sampled at 1 to {MOST_PLACES} places, not at {count}")]
    Places {
        /// What was asked for.
        count: u32,
    },
}

/// Refuses a list that has not one entry for each pixel or sample.
pub(crate) fn check_length(
    what: &'static str,
    found: usize,
    expected: usize,
) -> Result<(), TruthError> {
    if found == expected {
        Ok(())
    } else {
        Err(TruthError::Length {
            what,
            found,
            expected,
        })
    }
}
