//! What can be wrong with a scene.

use std::path::PathBuf;

/// Why a scene could not be loaded. Each names the file and the item in it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Neither a file nor a scene of our own has this name.
    #[error("there is no file '{name}', nor a procedural scene of that name; {advice}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names that exist.
        advice: String,
    },
    /// The file could not be read.
    #[error("'{}' could not be read: {source}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is no glTF, or breaks its rules.
    #[error("'{}' is not valid glTF: {reason}", file.display())]
    Malformed {
        /// The file.
        file: PathBuf,
        /// Where and how.
        reason: String,
    },
    /// The file cannot be shown without an extension that is not supported.
    #[error(
        "'{}' requires the extension '{extension}', which is not supported; export it without compression and texture extensions",
        file.display()
    )]
    Extension {
        /// The file.
        file: PathBuf,
        /// The extension's name.
        extension: String,
    },
    /// A buffer is missing or too short.
    #[error("'{}': buffer {buffer} cannot be used: {reason}", file.display())]
    Buffer {
        /// The file.
        file: PathBuf,
        /// Its index in the file.
        buffer: usize,
        /// What is missing.
        reason: String,
    },
    /// An accessor reaches beyond its data or has the wrong type.
    #[error("'{}': {item} cannot be read: {reason}", file.display())]
    Accessor {
        /// The file.
        file: PathBuf,
        /// Mesh, primitive, attribute and accessor.
        item: String,
        /// What is wrong.
        reason: String,
    },
    /// A triangle names a vertex that does not exist.
    #[error("'{}': {item} has the index {index}, but only {vertices} vertices", file.display())]
    Index {
        /// The file.
        file: PathBuf,
        /// Mesh and primitive.
        item: String,
        /// The index.
        index: u32,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A vertex is NaN or infinite.
    #[error("'{}': {item}, vertex {vertex}: {attribute} is {value:?}, which is not finite", file.display())]
    Vertex {
        /// The file.
        file: PathBuf,
        /// Mesh and primitive.
        item: String,
        /// The vertex's index.
        vertex: usize,
        /// Which attribute.
        attribute: &'static str,
        /// Its value.
        value: Vec<f32>,
    },
    /// A vertex lies too far away.
    #[error(
        "'{}': {item}, vertex {vertex} lies at {position:?}, further than {limit:e} from the origin; scale the scene down",
        file.display()
    )]
    Far {
        /// The file.
        file: PathBuf,
        /// Mesh and primitive.
        item: String,
        /// The vertex's index.
        vertex: usize,
        /// Where it is placed.
        position: [f32; 3],
        /// The largest coordinate.
        limit: f32,
    },
    /// A node cannot be placed.
    #[error("'{}': {node} cannot be placed: {reason}", file.display())]
    Node {
        /// The file.
        file: PathBuf,
        /// The node's name and index.
        node: String,
        /// What is wrong.
        reason: String,
    },
    /// A texture's image cannot be decoded.
    #[error("'{}': image {image} cannot be used: {reason}", file.display())]
    Image {
        /// The file.
        file: PathBuf,
        /// Its index in the file.
        image: usize,
        /// What is wrong.
        reason: String,
    },
    /// Nothing would be visible.
    #[error("'{}' has no triangles that can be shown", file.display())]
    NoTriangles {
        /// The file.
        file: PathBuf,
    },
    /// More than this host is made for.
    #[error("'{}': {item} has {count} {unit}, more than the limit of {limit}", file.display())]
    TooLarge {
        /// The file.
        file: PathBuf,
        /// What is too large.
        item: String,
        /// How many there are.
        count: u64,
        /// Of what.
        unit: &'static str,
        /// How many there may be.
        limit: u64,
    },
}
