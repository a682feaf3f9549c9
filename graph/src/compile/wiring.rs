//! Names, edges and order: everything about a graph that needs no node's description.

use std::collections::{BTreeMap, BTreeSet};

use moment_shadows::nearest;

use crate::{Endpoint, Graph, GraphError, GraphErrorKind};

/// Where an input comes from.
#[derive(Clone, Debug)]
pub(super) enum Source {
    /// An import's index.
    Import(usize),
    /// A node's index and the name of its slot.
    Node(usize, String),
}

/// A graph's connections, checked.
#[derive(Debug)]
pub(super) struct Wiring {
    /// For each node: what leads to its slots, with the edge's index.
    pub(super) inputs: Vec<BTreeMap<String, (Source, usize)>>,
    /// Node indices such that every node comes after those it depends on; otherwise in file order.
    pub(super) order: Vec<usize>,
}

impl Wiring {
    pub(super) fn of(graph: &Graph) -> Result<Self, GraphError> {
        unique(
            "import or node",
            graph
                .imports
                .iter()
                .map(|import| (import.name.as_str(), import.position))
                .chain(
                    graph
                        .nodes
                        .iter()
                        .map(|node| (node.name.as_str(), node.position)),
                ),
        )?;
        unique(
            "output",
            graph
                .outputs
                .iter()
                .map(|output| (output.name.as_str(), output.position)),
        )?;
        let mut inputs = vec![BTreeMap::new(); graph.nodes.len()];
        for (index, edge) in graph.edges.iter().enumerate() {
            let placed = |error: GraphError| error.at_position(edge.position);
            let source = source(graph, &edge.from).map_err(placed)?;
            let (node, slot) = target(graph, &edge.to).map_err(placed)?;
            if inputs[node].insert(slot.clone(), (source, index)).is_some() {
                return Err(placed(
                    GraphError::new(
                        GraphErrorKind::TwoWriters,
                        "two edges lead to this input; remove one of them",
                    )
                    .at_node(&graph.nodes[node].name)
                    .at_slot(&slot),
                ));
            }
        }
        let order = order(graph, &inputs)?;
        Ok(Self { inputs, order })
    }

    /// Nodes that the outputs depend on.
    pub(super) fn needed(&self, graph: &Graph) -> Result<BTreeSet<usize>, GraphError> {
        let mut pending = Vec::new();
        for output in &graph.outputs {
            if let Source::Node(node, _) =
                source(graph, &output.from).map_err(|error| error.at_position(output.position))?
            {
                pending.push(node);
            }
        }
        let mut needed = BTreeSet::new();
        while let Some(node) = pending.pop() {
            if needed.insert(node) {
                pending.extend(
                    self.inputs[node]
                        .values()
                        .filter_map(|(source, _)| match source {
                            Source::Node(upstream, _) => Some(*upstream),
                            Source::Import(_) => None,
                        }),
                );
            }
        }
        Ok(needed)
    }
}

/// What an edge or an output starts from.
pub(super) fn source(graph: &Graph, endpoint: &Endpoint) -> Result<Source, GraphError> {
    match &endpoint.slot {
        None => graph
            .imports
            .iter()
            .position(|import| import.name == endpoint.owner)
            .map(Source::Import)
            .ok_or_else(|| {
                unknown(
                    "import",
                    &endpoint.owner,
                    graph.imports.iter().map(|import| import.name.as_str()),
                    "an output of a node is written 'node.slot'",
                )
            }),
        Some(slot) => Ok(Source::Node(
            node_index(graph, &endpoint.owner)?,
            slot.clone(),
        )),
    }
}

fn target(graph: &Graph, endpoint: &Endpoint) -> Result<(usize, String), GraphError> {
    let node = node_index(graph, &endpoint.owner)?;
    let slot = endpoint.slot.clone().ok_or_else(|| {
        GraphError::new(
            GraphErrorKind::UnknownName,
            "an edge leads to a slot of a node; write 'node.slot'",
        )
        .at_node(&endpoint.owner)
    })?;
    Ok((node, slot))
}

fn node_index(graph: &Graph, name: &str) -> Result<usize, GraphError> {
    graph
        .nodes
        .iter()
        .position(|node| node.name == name)
        .ok_or_else(|| {
            unknown(
                "node",
                name,
                graph.nodes.iter().map(|node| node.name.as_str()),
                "edges and outputs name the graph's own nodes",
            )
        })
}

pub(super) fn unknown<'a>(
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

fn unique<'a>(
    what: &str,
    names: impl Iterator<Item = (&'a str, Option<crate::Position>)>,
) -> Result<(), GraphError> {
    let mut seen = BTreeSet::new();
    for (name, position) in names {
        let problem = if name.is_empty() || name.contains('.') {
            Some(GraphError::new(
                GraphErrorKind::UnknownName,
                format!(
                    "'{name}' cannot be the name of an {what}: names are not empty and have no '.'"
                ),
            ))
        } else if seen.insert(name) {
            None
        } else {
            Some(GraphError::new(
                GraphErrorKind::DuplicateName,
                format!("there is already an {what} named '{name}'; rename one of them"),
            ))
        };
        if let Some(error) = problem {
            return Err(error.at_position(position));
        }
    }
    Ok(())
}

fn order(
    graph: &Graph,
    inputs: &[BTreeMap<String, (Source, usize)>],
) -> Result<Vec<usize>, GraphError> {
    let mut order = Vec::with_capacity(inputs.len());
    let mut placed = vec![false; inputs.len()];
    while order.len() < inputs.len() {
        let ready = (0..inputs.len()).find(|&node| {
            !placed[node]
                && inputs[node].values().all(|(source, _)| match source {
                    Source::Node(upstream, _) => placed[*upstream],
                    Source::Import(_) => true,
                })
        });
        let Some(node) = ready else {
            return Err(cycle(graph, inputs, &placed));
        };
        placed[node] = true;
        order.push(node);
    }
    Ok(order)
}

/// Walks upstream among the nodes that could not be placed until one comes again.
fn cycle(
    graph: &Graph,
    inputs: &[BTreeMap<String, (Source, usize)>],
    placed: &[bool],
) -> GraphError {
    let unplaced_upstream = |node: usize| {
        inputs[node].values().find_map(|(source, _)| match source {
            Source::Node(upstream, _) if !placed[*upstream] => Some(*upstream),
            Source::Node(..) | Source::Import(_) => None,
        })
    };
    let mut path: Vec<usize> = Vec::new();
    let mut current = placed.iter().position(|done| !done);
    while let Some(node) = current {
        if let Some(start) = path.iter().position(|&visited| visited == node) {
            path.drain(..start);
            break;
        }
        path.push(node);
        current = unplaced_upstream(node);
    }
    let names: Vec<&str> = path
        .iter()
        .rev()
        .map(|&node| graph.nodes[node].name.as_str())
        .collect();
    let first = path.last().copied().unwrap_or_default();
    GraphError::new(
        GraphErrorKind::Cycle,
        format!(
            "the nodes {} wait for each other; remove one of the edges between them",
            names.join(" -> ")
        ),
    )
    .at_node(&graph.nodes[first].name)
    .at_position(graph.nodes[first].position)
}
