//! The example graph, whole or with a piece of its text replaced, and what is said about it.

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, GraphError, GraphErrorKind, NodeRegistry, Plan};

pub(crate) const TEXT: &str = include_str!("../support/example.json");

/// The example with one piece of text replaced.
pub(crate) fn edited(from: &str, to: &str) -> String {
    assert_eq!(TEXT.matches(from).count(), 1, "'{from}' occurs once");
    TEXT.replace(from, to)
}

pub(crate) fn parse(text: &str) -> Result<Graph, GraphError> {
    Graph::parse(text, &NodeRegistry::new())
}

pub(crate) fn native() -> Capabilities {
    Capabilities::of_profile(Profile::Native)
}

/// Compiles a text with the imports that it describes itself.
pub(crate) fn compiled(text: &str, capabilities: &Capabilities) -> Result<Plan, GraphError> {
    parse(text)?.compile(capabilities, &[])
}

/// What is wrong with a text, on a native device.
pub(crate) fn refused(text: &str) -> GraphError {
    compiled(text, &native()).unwrap_err()
}

/// The kind of an error, the node and the slot that it names, and its place as `line:column`.
pub(crate) fn place(error: &GraphError) -> (GraphErrorKind, &str, &str, String) {
    (
        error.kind,
        error.node.as_deref().unwrap_or(""),
        error.slot.as_deref().unwrap_or(""),
        error
            .position
            .map_or(String::new(), |position| position.to_string()),
    )
}

/// Asserts everything about an error but the rest of its sentence.
#[track_caller]
pub(crate) fn assert_error(
    error: &GraphError,
    kind: GraphErrorKind,
    node: &str,
    slot: &str,
    position: &str,
    says: &str,
) {
    assert_eq!(
        place(error),
        (kind, node, slot, position.to_owned()),
        "{error}"
    );
    assert!(error.message.contains(says), "'{says}' in: {error}");
}

/// The place of the last byte of `needle`, which occurs once, as `line:column`: where a key or a value has been read.
pub(crate) fn end_of(text: &str, needle: &str) -> String {
    assert_eq!(text.matches(needle).count(), 1, "'{needle}' occurs once");
    let before = &text[..text.find(needle).unwrap() + needle.len()];
    let line = before.rsplit('\n').next().unwrap();
    format!("{}:{}", before.matches('\n').count() + 1, line.len())
}
