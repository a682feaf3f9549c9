//! What nodes may take of each other: nothing of a later stage, and nothing that another one changes in place.

use std::collections::BTreeMap;

use super::Described;
use super::wiring::Wiring;
use crate::error::ensure;
use crate::{Direction, Graph, GraphError, GraphErrorKind, Slot, Stage};

/// A node cannot be recorded before one that it depends on.
pub(super) fn stages_in_order(
    graph: &Graph,
    wiring: &Wiring,
    described: &[Described],
) -> Result<(), GraphError> {
    let stages = described
        .iter()
        .map(|described| (described.node, described.desc.stage));
    let stages: BTreeMap<usize, Stage> = stages.collect();
    for (node, inputs) in wiring.inputs.iter().enumerate() {
        let name = &graph.nodes[node].name;
        for (source, edge) in inputs.values() {
            let Some(upstream) = *source else { continue };
            let in_order = stages.get(&upstream) <= stages.get(&node);
            ensure(in_order, GraphErrorKind::StageOrder, || {
                format!(
                    "it is recorded before '{}', whose output it reads; connect it to a node of an earlier stage",
                    graph.nodes[upstream].name
                )
            })
            .map_err(|error| error.at_node(name).at_position(graph.edges[*edge].position))?;
        }
    }
    Ok(())
}

/// What a node changes in place nobody else takes: whether they saw it before or after would depend on the order.
pub(super) fn changed_in_place_by_one(
    graph: &Graph,
    wiring: &Wiring,
    described: &[Described],
) -> Result<(), GraphError> {
    for described in described {
        let name = &graph.nodes[described.node].name;
        let in_place = |slot: &&Slot| slot.direction == Direction::InOut;
        for slot in described.desc.slots.iter().filter(in_place) {
            let Some((_, edge)) = wiring.inputs[described.node].get(&slot.name) else {
                continue;
            };
            let from = &graph.edges[*edge].from;
            let edges = graph.edges.iter().enumerate();
            let others = edges.filter(|(other, _)| other != edge);
            let others = others.map(|(_, other)| (&other.from, other.position));
            let outputs = graph.outputs.iter();
            let outputs = outputs.map(|output| (&output.value, output.position));
            let taken = others.chain(outputs).find(|(other, _)| *other == from);
            if let Some((_, position)) = taken {
                return Err(GraphError::new(
                    GraphErrorKind::TwoWriters,
                    format!(
                        "'{from}' is changed in place here and taken elsewhere, too; take '{name}.{}' there instead",
                        slot.name
                    ),
                )
                .at_node(name)
                .at_slot(&slot.name)
                .at_position(position));
            }
        }
    }
    Ok(())
}
