//! What can be wrong with a graph, its plan or a recording, and where.

use core::fmt;

use moment_shadows::nearest;
use serde::{Deserialize, Serialize};

/// A place in a graph file, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Position {
    /// The line.
    pub line: u32,
    /// The column, in bytes.
    pub column: u32,
}

impl Position {
    /// The beginning of a file.
    pub(crate) const START: Position = Position { line: 1, column: 1 };

    /// The position behind `text`, where `text` begins at this one.
    pub(crate) fn after(self, text: &[u8]) -> Self {
        let count = |bytes: usize| u32::try_from(bytes).unwrap_or(u32::MAX);
        let lines = text.iter().filter(|&&byte| byte == b'\n').count();
        match text.iter().rposition(|&byte| byte == b'\n') {
            None => Self {
                column: self.column.saturating_add(count(text.len())),
                ..self
            },
            Some(end) => Self {
                line: self.line.saturating_add(count(lines)),
                column: count(text.len() - end),
            },
        }
    }
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.line, self.column)
    }
}

/// The kinds of things that can be wrong with a graph, with its plan, or with what a plan is recorded with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GraphErrorKind {
    /// Not JSON, a missing or an unknown key, or a value of the wrong type.
    Syntax,
    /// A version that this library does not know.
    Version,
    /// A node type that nobody registered.
    UnknownNodeType,
    /// Two imports, nodes, slots or outputs of one name.
    DuplicateName,
    /// A name that refers to nothing.
    UnknownName,
    /// A property whose value the node cannot work with.
    Property,
    /// A required input that nothing is connected to.
    MissingInput,
    /// An input that more than one edge leads to, or a resource that is changed in place while others take it.
    TwoWriters,
    /// Nodes that wait for each other.
    Cycle,
    /// A node that reads what only a later stage makes.
    StageOrder,
    /// A texture where a buffer is needed, a wrong format or a wrong number of samples.
    Format,
    /// A size, a number of layers or a kernel that does not fit.
    Size,
    /// Something that the device or the profile does not offer.
    Capability,
    /// A shader that does not link or validate, or that does not match what its node declares.
    Shader,
    /// A declaration that contradicts itself: a node's own fault.
    Declaration,
    /// An import that the host did not describe, or did not bind.
    MissingImport,
    /// An import that is bound, but is not what the plan was compiled for.
    Import,
    /// A plan that does not hold together, or that pipelines, resources or the device do not belong to.
    Plan,
    /// Uniform data or regions that do not fit their place in a view's block, or a block that does not fit the buffer.
    Parameters,
    /// Layers, passes or timestamps that a recording asks for and cannot have.
    Recording,
    /// An object that the device refused to create.
    Device,
    /// The device has no memory left.
    OutOfMemory,
    /// The device was lost or destroyed: create everything anew on another one.
    Lost,
}

/// Why a graph cannot be used, a plan not be recorded, or a value not be written. Nothing half-made is left.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub struct GraphError {
    /// What is wrong.
    pub kind: GraphErrorKind,
    /// The node it is about.
    pub node: Option<String>,
    /// The slot of the node.
    pub slot: Option<String>,
    /// The place in the graph file, where there is one.
    pub position: Option<Position>,
    /// What was found, and what to do.
    pub message: String,
}

impl GraphError {
    /// An error of a kind; the sentence says what was found and what to do.
    pub fn new(kind: GraphErrorKind, message: impl Into<String>) -> Self {
        Self {
            kind,
            node: None,
            slot: None,
            position: None,
            message: message.into(),
        }
    }

    /// This error, said of a node, unless it already names one.
    #[must_use]
    pub fn at_node(mut self, node: &str) -> Self {
        self.node.get_or_insert_with(|| node.to_owned());
        self
    }

    /// This error, said of a slot.
    #[must_use]
    pub fn at_slot(mut self, slot: &str) -> Self {
        self.slot.get_or_insert_with(|| slot.to_owned());
        self
    }

    /// This error with its place in the file, unless it already has one.
    #[must_use]
    pub fn at_position(mut self, position: Option<Position>) -> Self {
        self.position = self.position.or(position);
        self
    }
}

/// An error of a kind unless a condition `holds`.
pub(crate) fn ensure<M: Into<String>>(
    holds: bool,
    kind: GraphErrorKind,
    message: impl FnOnce() -> M,
) -> Result<(), GraphError> {
    let held = holds.then_some(());
    held.ok_or_else(|| GraphError::new(kind, message()))
}

/// The error about a name that is none of the `known` ones.
pub(crate) fn unknown<'a>(
    what: &str,
    name: &str,
    known: impl Iterator<Item = &'a str>,
    remark: &str,
) -> GraphError {
    let nearest = nearest(name, known);
    let hint = if nearest.is_empty() {
        "there is none".to_owned()
    } else {
        format!("the nearest are {nearest}")
    };
    GraphError::new(
        GraphErrorKind::UnknownName,
        format!("there is no {what} '{name}'; {hint} ({remark})"),
    )
}

impl fmt::Display for GraphError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(position) = self.position {
            write!(f, "{position}: ")?;
        }
        if let Some(node) = &self.node {
            write!(f, "node '{node}'")?;
            if let Some(slot) = &self.slot {
                write!(f, ", slot '{slot}'")?;
            }
            f.write_str(": ")?;
        }
        f.write_str(&self.message)
    }
}
