//! What callers have to know of a function.

use naga::Span;
use naga::diagnostic_filter::Severity;

/// What a value or the control flow in a function may depend on: what is given with a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// The control flow where the function is called.
    Call,
    /// The argument of that place; for a pointer, where it points.
    Argument(usize),
    /// What the argument of that place points at, before the call.
    Contents(usize),
}

/// Something that has to be uniform.
#[derive(Clone, Debug)]
pub(super) struct Requirement {
    /// The builtin function that requires it.
    pub(super) by: &'static str,
    /// Where that stands.
    pub(super) span: Span,
    /// The calls on the way from an entry point to it, the innermost first.
    pub(super) calls: Vec<Span>,
    /// Whether the control flow has to be uniform, or else the argument of the builtin function.
    pub(super) control_flow: bool,
    /// What breaking it is.
    pub(super) severity: Severity,
}

/// A result: whether it is not uniform whatever is given, and what it depends on.
#[derive(Clone, Debug, Default)]
pub(super) struct Outcome {
    pub(super) never_uniform: bool,
    pub(super) sources: Vec<Source>,
}

/// What callers have to know of a function.
#[derive(Clone, Debug, Default)]
pub(super) struct Summary {
    /// What has to be uniform with each call.
    pub(super) required: Vec<(Source, Requirement)>,
    pub(super) returned: Outcome,
    /// For each argument that points into a function's memory, what is there afterwards.
    pub(super) contents: Vec<Option<Outcome>>,
}
