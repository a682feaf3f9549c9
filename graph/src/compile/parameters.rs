//! Where uniform data lies in the block of a view: the parameters of nodes, and the regions of maps.

use moment_shadows::MapRegion;

use super::{Described, Known, declaration};
use crate::error::ensure;
use crate::{
    BindingResource, Capabilities, Graph, GraphError, GraphErrorKind, ParameterLayout,
    PlannedParameters, PlannedRegions,
};

/// Places the parameters of all kept nodes and the regions of the maps that they work on.
pub(super) fn lay_out(
    graph: &Graph,
    kept: &[Described],
    known: &[Known],
    capabilities: &Capabilities,
) -> Result<ParameterLayout, GraphError> {
    let mut layout = ParameterLayout::default();
    for described in kept {
        let node = &graph.nodes[described.node].name;
        layout
            .place_parameters(node, described, known, capabilities)
            .and_then(|()| layout.place_regions(described, known, capabilities))
            .map_err(|error| error.at_node(node))?;
    }
    Ok(layout)
}

impl ParameterLayout {
    fn place_parameters(
        &mut self,
        node: &str,
        described: &Described,
        known: &[Known],
        capabilities: &Capabilities,
    ) -> Result<(), GraphError> {
        let Some(block) = &described.desc.parameters else {
            return Ok(());
        };
        let count = match &block.each_layer_of {
            None => 1,
            Some(slot) => {
                let resource = described.slots.get(slot).map(|&index| &known[index].desc);
                let resource = resource.ok_or_else(|| {
                    declaration(format!(
                        "its parameters are per layer of '{slot}', which is no slot"
                    ))
                })?;
                resource.layers()
            }
        };
        let (bytes, elements, initial) = (block.size, block.elements, block.initial.len());
        let holds = initial <= bytes as usize && bytes > 0 && elements > 0;
        ensure(holds, GraphErrorKind::Declaration, || {
            format!(
                "its parameters have {bytes} bytes, but {initial} bytes of initial values; a uniform struct is not empty, \
                 and holds its initial values"
            )
        })?;
        let aligned = elements == 1 || bytes.is_multiple_of(16);
        ensure(aligned, GraphErrorKind::Declaration, || {
            format!(
                "its parameters are an array of structs of {bytes} bytes; in a uniform array that is a multiple of 16"
            )
        })?;
        let size = u64::from(bytes) * u64::from(elements);
        let most = capabilities.max_uniform_size;
        ensure(size <= u64::from(most), GraphErrorKind::Size, || {
            format!(
                "{elements} x {} of {bytes} bytes are more than a uniform binding of this device holds ({most} bytes); at \
                 most {} of them are possible",
                block.name,
                most / bytes
            )
        })?;
        let (offset, stride) = self.reserve(size, count, capabilities)?;
        self.blocks.push(PlannedParameters {
            node: node.to_owned(),
            name: block.name.clone(),
            offset,
            size: bytes,
            elements,
            stride,
            count,
            initial: block.initial.clone(),
            fields: Vec::new(),
        });
        Ok(())
    }

    fn place_regions(
        &mut self,
        described: &Described,
        known: &[Known],
        capabilities: &Capabilities,
    ) -> Result<(), GraphError> {
        let bindings = described.desc.passes.iter().flat_map(|pass| &pass.bindings);
        for binding in bindings {
            let BindingResource::Regions { slot, smallest } = &binding.resource else {
                continue;
            };
            let of_map = |error: GraphError| error.at_slot(slot);
            let root = described.slots.get(slot).map(|&index| known[index].root);
            let map = root.and_then(|root| Some((&known[root].name, known[root].desc.texture()?)));
            let (name, map) = map.ok_or_else(|| {
                let message = "a pass takes the regions of this slot, which is no texture";
                of_map(declaration(message))
            })?;
            if let Some(table) = self.regions.iter_mut().find(|table| table.map == *name) {
                table.smallest = table.smallest.max(*smallest);
                continue;
            }
            let size = u64::from(map.regions) * size_of::<MapRegion>() as u64;
            let most = capabilities.max_uniform_size / size_of::<MapRegion>() as u32;
            ensure(map.regions <= most, GraphErrorKind::Size, || {
                format!(
                    "the map has {} regions per layer; a uniform binding of this device holds {most}",
                    map.regions
                )
            })
            .map_err(of_map)?;
            let place = self.reserve(size, map.layers, capabilities);
            let (offset, stride) = place.map_err(of_map)?;
            self.regions.push(PlannedRegions {
                map: name.clone(),
                offset,
                stride,
                layers: map.layers,
                capacity: map.regions,
                extent: map.size,
                smallest: (*smallest).max(1),
                initial: bytemuck::bytes_of(&MapRegion::WHOLE).to_vec(),
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
        let offset = self.size;
        let end = u64::from(offset) + stride * u64::from(count);
        let most = Self::MOST_BYTES;
        let fits = stride.max(end) <= u64::from(most);
        ensure(fits, GraphErrorKind::Size, || {
            format!(
                "a view's parameters take {end} bytes with those of this node; at most {most} are possible"
            )
        })?;
        self.size = end as u32;
        Ok((offset, stride as u32))
    }
}
