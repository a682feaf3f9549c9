//! What can be wrong with a scene that is to be peeled.

/// Why the surfaces along a light's rays cannot be listed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PeelError {
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
    /// There are no rays.
    #[error("a map of {}x{} texels has no rays; give it at least one texel each way", map[0], map[1])]
    Empty {
        /// Width and height in texels.
        map: [u32; 2],
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
}
