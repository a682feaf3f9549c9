//! Names, edges and order: everything about a graph that needs no node's description.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::{ensure, unknown};
use crate::{Graph, GraphError, GraphErrorKind, Position};

/// For each of a node's slots the node that an edge leads from, unless it is an import, and the edge's index.
type Inputs = BTreeMap<String, (Option<usize>, usize)>;

/// The nodes that a node depends on.
fn upstream(inputs: &Inputs) -> impl Iterator<Item = usize> {
    inputs.values().filter_map(|(node, _)| *node)
}

/// A graph's connections, checked.
#[derive(Debug)]
pub(super) struct Wiring {
    /// For each node.
    pub(super) inputs: Vec<Inputs>,
    /// Node indices such that every node comes after those it depends on; otherwise in file order.
    pub(super) order: Vec<usize>,
}

impl Wiring {
    pub(super) fn of(graph: &Graph) -> Result<Self, GraphError> {
        let imports = graph.imports.iter();
        let imports = imports.map(|import| (&import.name, import.position));
        let nodes = graph.nodes.iter().map(|node| (&node.name, node.position));
        unique("import or node", imports.chain(nodes))?;
        let outputs = graph.outputs.iter();
        unique(
            "output",
            outputs.map(|output| (&output.name, output.position)),
        )?;
        let mut inputs = vec![BTreeMap::new(); graph.nodes.len()];
        for (index, edge) in graph.edges.iter().enumerate() {
            let placed = |error: GraphError| error.at_position(edge.position);
            let source = source(graph, &edge.from).map_err(placed)?;
            let (node, slot) = target(graph, &edge.to).map_err(placed)?;
            if inputs[node].insert(slot.clone(), (source, index)).is_some() {
                let message = "two edges lead to this input; remove one of them";
                let error = GraphError::new(GraphErrorKind::TwoWriters, message).at_slot(&slot);
                return Err(placed(error.at_node(&graph.nodes[node].name)));
            }
        }
        let order = order(graph, &inputs)?;
        Ok(Self { inputs, order })
    }

    /// Nodes that the outputs depend on.
    pub(super) fn needed(&self, graph: &Graph) -> Result<BTreeSet<usize>, GraphError> {
        let mut pending = Vec::new();
        for output in &graph.outputs {
            let source = source(graph, &output.value)?;
            pending.extend(source);
        }
        let mut needed = BTreeSet::new();
        while let Some(node) = pending.pop() {
            if needed.insert(node) {
                pending.extend(upstream(&self.inputs[node]));
            }
        }
        Ok(needed)
    }
}

/// The node that an edge or an output starts from; `None` for an import.
fn source(graph: &Graph, from: &str) -> Result<Option<usize>, GraphError> {
    match from.split_once('.') {
        Some((node, _)) => node_index(graph, node).map(Some),
        None => import_index(graph, from).map(|_| None),
    }
}

pub(super) fn import_index(graph: &Graph, from: &str) -> Result<usize, GraphError> {
    let mut names = graph.imports.iter().map(|import| import.name.as_str());
    let index = names.clone().position(|name| name == from);
    index.ok_or_else(|| {
        let remark = "an output of a node is written 'node.slot'";
        unknown("import", from, names.by_ref(), remark)
    })
}

fn target(graph: &Graph, to: &str) -> Result<(usize, String), GraphError> {
    let (node, slot) = to.split_once('.').unwrap_or((to, ""));
    let index = node_index(graph, node)?;
    if node == to {
        let message = "an edge leads to a slot of a node; write 'node.slot'";
        return Err(GraphError::new(GraphErrorKind::UnknownName, message).at_node(node));
    }
    Ok((index, slot.to_owned()))
}

pub(super) fn node_index(graph: &Graph, name: &str) -> Result<usize, GraphError> {
    let names = graph.nodes.iter().map(|node| node.name.as_str());
    let index = names.clone().position(|node| node == name);
    index.ok_or_else(|| {
        let remark = "edges and outputs name the graph's own nodes";
        unknown("node", name, names, remark)
    })
}

fn unique<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a String, Option<Position>)>,
) -> Result<(), GraphError> {
    let mut seen = BTreeSet::new();
    for (name, position) in names {
        let allowed = !name.is_empty() && !name.contains('.');
        ensure(allowed, GraphErrorKind::UnknownName, || {
            format!("'{name}' cannot be the name of an {what}: names are not empty and have no '.'")
        })
        .and_then(|()| {
            ensure(seen.insert(name), GraphErrorKind::DuplicateName, || {
                format!("there is already an {what} named '{name}'; rename one of them")
            })
        })
        .map_err(|error| error.at_position(position))?;
    }
    Ok(())
}

fn order(graph: &Graph, inputs: &[Inputs]) -> Result<Vec<usize>, GraphError> {
    let mut order = Vec::with_capacity(inputs.len());
    let mut placed = vec![false; inputs.len()];
    while order.len() < inputs.len() {
        let ready = |node: &usize| {
            !placed[*node] && upstream(&inputs[*node]).all(|upstream| placed[upstream])
        };
        let ready = (0..inputs.len()).find(ready);
        let Some(node) = ready else {
            return Err(cycle(graph, inputs, &placed));
        };
        placed[node] = true;
        order.push(node);
    }
    Ok(order)
}

/// Walks upstream among the nodes that could not be placed until one comes again.
fn cycle(graph: &Graph, inputs: &[Inputs], placed: &[bool]) -> GraphError {
    let mut path: Vec<usize> = Vec::new();
    let mut current = placed.iter().position(|done| !done);
    while let Some(node) = current {
        if let Some(start) = path.iter().position(|&visited| visited == node) {
            path.drain(..start);
            break;
        }
        path.push(node);
        current = upstream(&inputs[node]).find(|&upstream| !placed[upstream]);
    }
    let names: Vec<&str> = path
        .iter()
        .rev()
        .map(|&node| graph.nodes[node].name.as_str())
        .collect();
    let first = path.last().copied().unwrap_or_default();
    let error = GraphError::new(
        GraphErrorKind::Cycle,
        format!(
            "the nodes {} wait for each other; remove one of the edges between them",
            names.join(" -> ")
        ),
    );
    graph.nodes[first].placed(error)
}
