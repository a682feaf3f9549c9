//! The graph of uniformity (WGSL specification, section 15.2): an edge says that one value, or the control flow at one place, is
//! uniform only if another is.

use std::collections::VecDeque;

use naga::{BuiltIn, Expression, Handle, Span};

/// A value or the control flow at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) struct Node(usize);

/// What a node is, for those that an explanation points at.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Label {
    /// Control flow that a condition decides.
    Condition(Span),
    /// The parameter of that place.
    Parameter(u32),
    /// A builtin that an entry point takes.
    BuiltIn(BuiltIn, Span),
    /// Another input of an entry point.
    Input(Span),
    /// Memory that other invocations, or other calls, write.
    Memory(Handle<Expression>),
    /// The result of a function that is not uniform whatever it is given.
    Result(Span),
}

/// The nodes of one function, with what depends on what.
#[derive(Default)]
pub(super) struct Graph {
    /// For each node, the nodes that depend on it.
    dependents: Vec<Vec<Node>>,
    labels: Vec<Option<Label>>,
}

impl Graph {
    /// A node that depends on `on`.
    pub(super) fn node(&mut self, on: &[Node]) -> Node {
        let node = Node(self.dependents.len());
        self.dependents.push(Vec::new());
        self.labels.push(None);
        for other in on {
            self.depend(node, *other);
        }
        node
    }

    /// A node that depends on `on` and is what the label says.
    pub(super) fn labelled(&mut self, on: &[Node], label: Label) -> Node {
        let node = self.node(on);
        if let Some(place) = self.labels.get_mut(node.0) {
            *place = Some(label);
        }
        node
    }

    /// Says that `node` depends on `on`.
    pub(super) fn depend(&mut self, node: Node, on: Node) {
        if let Some(dependents) = self.dependents.get_mut(on.0)
            && node != on
            && dependents.last() != Some(&node)
        {
            dependents.push(node);
        }
    }

    pub(super) fn label(&self, node: Node) -> Option<&Label> {
        self.labels.get(node.0)?.as_ref()
    }

    /// All that depends on `source`, directly or through others.
    pub(super) fn reach(&self, source: Node) -> Reach {
        let mut next = vec![None; self.dependents.len()];
        let mut waiting = VecDeque::from([source]);
        if let Some(place) = next.get_mut(source.0) {
            *place = Some(source);
        }
        while let Some(node) = waiting.pop_front() {
            for dependent in self.dependents.get(node.0).into_iter().flatten() {
                if let Some(place @ None) = next.get_mut(dependent.0) {
                    *place = Some(node);
                    waiting.push_back(*dependent);
                }
            }
        }
        Reach { next }
    }
}

/// What depends on one node.
pub(super) struct Reach {
    /// For each node that does, the next one on the shortest way to it; for the node itself, itself.
    next: Vec<Option<Node>>,
}

impl Reach {
    pub(super) fn holds(&self, node: Node) -> bool {
        matches!(self.next.get(node.0), Some(Some(_)))
    }

    /// The way from `node`, which is its first.
    pub(super) fn way(&self, node: Node) -> Vec<Node> {
        let mut way = vec![node];
        let mut at = node;
        while let Some(Some(next)) = self.next.get(at.0)
            && *next != at
        {
            at = *next;
            way.push(at);
        }
        way
    }
}
