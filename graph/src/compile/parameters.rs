//! Where each node's uniform data lies in the block of a view.

use std::collections::BTreeMap;

use super::Described;
use crate::{
    Capabilities, Graph, GraphError, GraphErrorKind, ParameterLayout, PlannedParameters,
    PlannedResource,
};

/// Places the parameters of all kept nodes; the map gives each node's block.
pub(super) fn lay_out(
    graph: &Graph,
    kept: &[&Described],
    resources: &[PlannedResource],
    capabilities: &Capabilities,
) -> Result<(ParameterLayout, BTreeMap<usize, usize>), GraphError> {
    let alignment = u64::from(capabilities.uniform_alignment.max(16));
    let mut layout = ParameterLayout {
        size: 0,
        blocks: Vec::new(),
    };
    let mut blocks = BTreeMap::new();
    for described in kept {
        let Some(block) = &described.desc.parameters else {
            continue;
        };
        let node = &graph.nodes[described.node].name;
        let fail =
            |message: String| GraphError::new(GraphErrorKind::Declaration, message).at_node(node);
        let count = match &block.each_layer_of {
            None => 1,
            Some(slot) => described
                .slots
                .get(slot)
                .map(|&resource| resources[resource].desc.layers())
                .ok_or_else(|| {
                    fail(format!(
                        "its parameters are per layer of '{slot}', which is no slot"
                    ))
                })?,
        };
        if block.initial.len() > block.size as usize || block.size == 0 {
            return Err(fail(format!(
                "its parameters have {} bytes, but {} bytes of initial values; a uniform struct is not empty, and holds \
                 its initial values",
                block.size,
                block.initial.len()
            )));
        }
        let stride = u64::from(block.size).next_multiple_of(alignment);
        let size = u64::from(layout.size) + stride * u64::from(count);
        let too_large = |_| {
            GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "a view's parameters take {size} bytes with those of this node; at most {} can be addressed",
                    u32::MAX
                ),
            )
            .at_node(node)
        };
        blocks.insert(described.node, layout.blocks.len());
        layout.blocks.push(PlannedParameters {
            node: node.clone(),
            name: block.name.clone(),
            offset: layout.size,
            size: block.size,
            stride: u32::try_from(stride).map_err(too_large)?,
            count,
            initial: block.initial.clone(),
        });
        layout.size = u32::try_from(size).map_err(too_large)?;
    }
    Ok((layout, blocks))
}
