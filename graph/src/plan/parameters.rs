//! Uniform data: where each node's lies in the block of a view, and writing it there.

use moment_shadows::MapRegion;
use serde::{Deserialize, Serialize};

use super::{PlannedBinding, PlannedBindingResource, PlannedOffset, PlannedRegions};
use crate::error::{ensure, unknown};
use crate::{GraphError, GraphErrorKind};

/// Where uniform data lies in the block of one view. A host keeps one block per view in a buffer of its own.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct ParameterLayout {
    /// Bytes of one view's block; blocks of several views follow each other at multiples of this.
    pub size: u32,
    /// The blocks of the nodes.
    pub blocks: Vec<PlannedParameters>,
    /// The tables of regions, one for each map that the host gives.
    pub regions: Vec<PlannedRegions>,
}

/// Where a node's uniform data lies.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedParameters {
    /// The node's name in the graph.
    pub node: String,
    /// The WGSL struct's name.
    pub name: String,
    /// Bytes from the start of the view's block.
    pub offset: u32,
    /// Bytes of one struct.
    pub size: u32,
    /// Structs that follow each other as an array.
    pub elements: u32,
    /// Bytes from one layer's structs to the next.
    pub stride: u32,
    /// How many such arrays there are: one, or one per layer.
    pub count: u32,
    /// What each struct holds until the host writes something else; zeros where empty.
    pub initial: Vec<u8>,
    /// The struct's members, in their order.
    pub fields: Vec<PlannedField>,
}

/// A member of a uniform struct.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedField {
    /// The name; that of a member of a member is joined by a point.
    pub name: String,
    /// The WGSL type: `f32`, `vec3f`, `mat4x4f`, `u32` or the like.
    #[serde(rename = "type")]
    pub ty: String,
    /// Bytes from the start of the struct.
    pub offset: u32,
    /// How many of them follow each other, in an array.
    pub count: u32,
    /// Bytes from one to the next; 0 where there is one.
    pub stride: u32,
}

impl PlannedParameters {
    /// Bytes of the array.
    #[must_use]
    pub fn array_size(&self) -> u64 {
        u64::from(self.size) * u64::from(self.elements)
    }

    /// Where a struct of a layer begins in the view's block.
    fn start(&self, layer: u32, element: u32) -> usize {
        start(self.offset, layer, self.stride)
            .saturating_add((element as usize).saturating_mul(self.size as usize))
    }

    /// Writes the initial values of a layer's structs, from number `first` on.
    fn reset(&self, bytes: &mut [u8], layer: u32, first: u32) {
        for element in first..self.elements {
            let start = self.start(layer, element);
            let end = start.saturating_add(self.size as usize);
            if let Some(place) = bytes.get_mut(start..end) {
                let (given, rest) = place.split_at_mut(self.initial.len().min(place.len()));
                given.copy_from_slice(&self.initial[..given.len()]);
                rest.fill(0);
            }
        }
    }
}

impl ParameterLayout {
    /// The most bytes of a view's block: what every device of WebGPU has room for in one buffer.
    pub const MOST_BYTES: u32 = 1 << 28;

    /// The dynamic offsets of a pass, whose bindings are in the order of their numbers.
    pub(crate) fn offsets(&self, bindings: &[PlannedBinding]) -> Vec<PlannedOffset> {
        let offsets = bindings.iter().filter_map(|binding| {
            let (offset, stride, count) = match binding.resource {
                PlannedBindingResource::Parameters { block } => {
                    let block = self.blocks.get(block)?;
                    (block.offset, block.stride, block.count)
                }
                PlannedBindingResource::Regions { table } => {
                    let table = self.regions.get(table)?;
                    (table.offset, table.stride, table.layers)
                }
                PlannedBindingResource::Texture { .. }
                | PlannedBindingResource::StorageTexture { .. }
                | PlannedBindingResource::Buffer { .. }
                | PlannedBindingResource::Sampler(_) => return None,
            };
            let stride = if count > 1 { stride } else { 0 };
            Some(PlannedOffset { offset, stride })
        });
        offsets.collect()
    }

    /// A view's block with every node's initial values. A plan from elsewhere is [checked](super::Plan::check) first: of one that is not,
    /// this may take long.
    #[must_use]
    pub fn initial(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.size as usize];
        for block in &self.blocks {
            (0..block.count).for_each(|layer| block.reset(&mut bytes, layer, 0));
        }
        for table in &self.regions {
            for layer in 0..table.layers {
                // Only a plan from elsewhere, which nothing records, has no room for a region.
                let _ = self.write_regions(&mut bytes, &table.map, layer, &[MapRegion::WHOLE]);
            }
        }
        bytes
    }

    /// Writes a node's struct (for `layer`, where there is one per layer) into a view's block. Where the node has an
    /// array of structs this is the first, and the others become what they were at the beginning.
    pub fn write<P: bytemuck::NoUninit>(
        &self,
        block: &mut [u8],
        node: &str,
        layer: u32,
        parameters: &P,
    ) -> Result<(), GraphError> {
        self.write_all(block, node, layer, core::slice::from_ref(parameters))
    }

    /// Writes a node's structs, as many as there are, into a view's block; the others become what they were at the
    /// beginning.
    pub fn write_all<P: bytemuck::NoUninit>(
        &self,
        block: &mut [u8],
        node: &str,
        layer: u32,
        parameters: &[P],
    ) -> Result<(), GraphError> {
        let planned = self.blocks.iter().find(|planned| planned.node == node);
        let planned = planned.ok_or_else(|| {
            let known = self.blocks.iter().map(|planned| planned.node.as_str());
            unknown("node with parameters", node, known, "in this plan")
        })?;
        let PlannedParameters {
            name,
            size,
            elements,
            count,
            ..
        } = planned;
        let (bytes, given) = (size_of::<P>(), parameters.len());
        fits(bytes == *size as usize, || {
            format!("its parameters ({name}) have {size} bytes, {bytes} were given")
        })
        .and(fits(given <= *elements as usize, || {
            format!("its parameters ({name}) are at most {elements} structs, {given} were given")
        }))
        .and(fits(layer < *count, || {
            format!("it has parameters for {count} layers; layer {layer} is none of them")
        }))
        .map_err(|error| error.at_node(node))?;
        let place = self.place(block, planned.start(layer, 0), planned.array_size())?;
        let bytes: &[u8] = bytemuck::cast_slice(parameters);
        place[..bytes.len()].copy_from_slice(bytes);
        planned.reset(block, layer, parameters.len() as u32);
        Ok(())
    }

    /// A place within a view's block, which may be too short.
    pub(super) fn place<'a>(
        &self,
        block: &'a mut [u8],
        start: usize,
        size: u64,
    ) -> Result<&'a mut [u8], GraphError> {
        let given = block.len();
        let size = usize::try_from(size).unwrap_or(usize::MAX);
        block
            .get_mut(start..start.saturating_add(size))
            .ok_or_else(|| {
                let message = format!("a view's block has {} bytes, {given} were given", self.size);
                GraphError::new(GraphErrorKind::Parameters, message)
            })
    }
}

/// Where a layer's data begins. A plan from elsewhere may say what no block reaches.
pub(super) fn start(offset: u32, layer: u32, stride: u32) -> usize {
    (layer as usize)
        .saturating_mul(stride as usize)
        .saturating_add(offset as usize)
}

/// Whether values fit the view's block.
pub(super) fn fits(holds: bool, message: impl FnOnce() -> String) -> Result<(), GraphError> {
    ensure(holds, GraphErrorKind::Parameters, message)
}
