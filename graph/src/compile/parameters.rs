//! Where uniform data lies in the block of a view: the parameters of nodes, and the regions of maps.

use std::collections::BTreeMap;

use moment_shadows::MapRegion;

use super::{Described, declaration};
use crate::{
    BindingResource, Capabilities, Graph, GraphError, GraphErrorKind, ParameterLayout,
    PlannedParameters, PlannedRegions, PlannedResource,
};

/// The layout under construction, and where things are in it.
pub(super) struct Places {
    pub(super) layout: ParameterLayout,
    /// Each node's block.
    pub(super) blocks: BTreeMap<usize, usize>,
    /// Each map's table of regions, by the resource whose regions they are.
    pub(super) tables: BTreeMap<usize, usize>,
}

/// Places the parameters of all kept nodes and the regions of the maps that they work on.
pub(super) fn lay_out(
    graph: &Graph,
    kept: &[&Described],
    resources: &[PlannedResource],
    roots: &[usize],
    capabilities: &Capabilities,
) -> Result<Places, GraphError> {
    let mut places = Places {
        layout: ParameterLayout {
            size: 0,
            blocks: Vec::new(),
            regions: Vec::new(),
        },
        blocks: BTreeMap::new(),
        tables: BTreeMap::new(),
    };
    for described in kept {
        let node = &graph.nodes[described.node].name;
        places
            .place_parameters(node, described, resources, capabilities)
            .and_then(|()| places.place_regions(described, resources, roots, capabilities))
            .map_err(|error| error.at_node(node))?;
    }
    Ok(places)
}

impl Places {
    fn place_parameters(
        &mut self,
        node: &str,
        described: &Described,
        resources: &[PlannedResource],
        capabilities: &Capabilities,
    ) -> Result<(), GraphError> {
        let Some(block) = &described.desc.parameters else {
            return Ok(());
        };
        let count = match &block.each_layer_of {
            None => 1,
            Some(slot) => described
                .slots
                .get(slot)
                .map(|&resource| resources[resource].desc.layers())
                .ok_or_else(|| {
                    declaration(format!(
                        "its parameters are per layer of '{slot}', which is no slot"
                    ))
                })?,
        };
        if block.initial.len() > block.size as usize || block.size == 0 || block.elements == 0 {
            return Err(declaration(format!(
                "its parameters have {} bytes, but {} bytes of initial values; a uniform struct is not empty, and holds \
                 its initial values",
                block.size,
                block.initial.len()
            )));
        }
        if block.elements > 1 && !block.size.is_multiple_of(16) {
            return Err(declaration(format!(
                "its parameters are an array of structs of {} bytes; in a uniform array that is a multiple of 16",
                block.size
            )));
        }
        let size = u64::from(block.size) * u64::from(block.elements);
        if size > u64::from(capabilities.max_uniform_size) {
            return Err(GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "{} x {} of {} bytes are more than a uniform binding of this device holds ({} bytes); at most {} \
                     of them are possible",
                    block.elements,
                    block.name,
                    block.size,
                    capabilities.max_uniform_size,
                    capabilities.max_uniform_size / block.size
                ),
            ));
        }
        let (offset, stride) = self.reserve(size, count, capabilities)?;
        self.blocks.insert(described.node, self.layout.blocks.len());
        self.layout.blocks.push(PlannedParameters {
            node: node.to_owned(),
            name: block.name.clone(),
            offset,
            size: block.size,
            elements: block.elements,
            stride,
            count,
            initial: block.initial.clone(),
        });
        Ok(())
    }

    fn place_regions(
        &mut self,
        described: &Described,
        resources: &[PlannedResource],
        roots: &[usize],
        capabilities: &Capabilities,
    ) -> Result<(), GraphError> {
        let bindings = described.desc.passes.iter().flat_map(|pass| &pass.bindings);
        for binding in bindings {
            let BindingResource::Regions(asked) = &binding.resource else {
                continue;
            };
            let root = described.slots.get(&asked.slot).map(|&slot| roots[slot]);
            let map = root.and_then(|root| Some((root, resources[root].desc.texture()?)));
            let Some((root, map)) = map else {
                return Err(declaration(
                    "a pass takes the regions of this slot, which is no texture".to_owned(),
                )
                .at_slot(&asked.slot));
            };
            if let Some(&table) = self.tables.get(&root) {
                let smallest = &mut self.layout.regions[table].smallest;
                *smallest = (*smallest).max(asked.smallest);
                continue;
            }
            let of_map = |error: GraphError| error.at_slot(&asked.slot);
            let size = u64::from(map.regions) * size_of::<MapRegion>() as u64;
            let most = capabilities.max_uniform_size / size_of::<MapRegion>() as u32;
            if map.regions > most {
                return Err(of_map(GraphError::new(
                    GraphErrorKind::Size,
                    format!(
                        "the map has {} regions per layer; a uniform binding of this device holds {most}",
                        map.regions
                    ),
                )));
            }
            let (offset, stride) = self
                .reserve(size, map.layers, capabilities)
                .map_err(of_map)?;
            self.tables.insert(root, self.layout.regions.len());
            self.layout.regions.push(PlannedRegions {
                map: resources[root].name.clone(),
                offset,
                stride,
                layers: map.layers,
                capacity: map.regions,
                extent: map.size,
                smallest: asked.smallest.max(1),
            });
        }
        Ok(())
    }

    /// Room for `count` bindings of `size` bytes: offset and stride.
    fn reserve(
        &mut self,
        size: u64,
        count: u32,
        capabilities: &Capabilities,
    ) -> Result<(u32, u32), GraphError> {
        let alignment = u64::from(capabilities.uniform_alignment.max(16));
        let stride = size.next_multiple_of(alignment);
        let offset = self.layout.size;
        let end = u64::from(offset) + stride * u64::from(count);
        let too_large = |_| {
            GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "a view's parameters take {end} bytes with those of this node; at most {} can be addressed",
                    u32::MAX
                ),
            )
        };
        let stride = u32::try_from(stride).map_err(too_large)?;
        self.layout.size = u32::try_from(end).map_err(too_large)?;
        Ok((offset, stride))
    }
}
