//! Uniform data: where each node's lies in the block of a view, and writing it there.

use serde::{Deserialize, Serialize};

use super::PlannedRegions;

/// Where uniform data lies in the block of one view. A host keeps one block per view in a buffer of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
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
}

/// Uniform data that does not fit its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// No recorded pass of that node has parameters.
    #[error("node '{node}' has no parameters in this plan; nodes that do: {known}")]
    UnknownNode {
        /// The node that was named.
        node: String,
        /// The nodes with parameters.
        known: String,
    },
    /// The struct has another size.
    #[error("parameters of node '{node}' ({name}) have {expected} bytes, {given} were given")]
    Size {
        /// The node.
        node: String,
        /// The WGSL struct.
        name: String,
        /// The struct's size.
        expected: u32,
        /// What was given.
        given: usize,
    },
    /// There are fewer structs.
    #[error(
        "parameters of node '{node}' ({name}) are at most {elements} structs, {given} were given"
    )]
    Elements {
        /// The node.
        node: String,
        /// The WGSL struct.
        name: String,
        /// How many there are.
        elements: u32,
        /// How many were given.
        given: usize,
    },
    /// There are fewer layers.
    #[error("node '{node}' has parameters for {count} layers; layer {layer} is none of them")]
    Layer {
        /// The node.
        node: String,
        /// How many structs there are.
        count: u32,
        /// The layer that was named.
        layer: u32,
    },
    /// The view's block is too small.
    #[error("a view's block has {expected} bytes, {given} were given")]
    Block {
        /// [`ParameterLayout::size`].
        expected: u32,
        /// What was given.
        given: usize,
    },
}

impl PlannedParameters {
    /// Bytes of the array.
    #[must_use]
    pub fn array_size(&self) -> u64 {
        u64::from(self.size) * u64::from(self.elements)
    }

    /// Where a struct of a layer begins in the view's block.
    fn start(&self, layer: u32, element: u32) -> usize {
        self.offset as usize
            + layer as usize * self.stride as usize
            + element as usize * self.size as usize
    }

    /// Writes the initial values of a layer's structs, from number `first` on.
    fn reset(&self, bytes: &mut [u8], layer: u32, first: u32) {
        for element in first..self.elements {
            let start = self.start(layer, element);
            if let Some(place) = bytes.get_mut(start..start + self.size as usize) {
                let (given, rest) = place.split_at_mut(self.initial.len().min(place.len()));
                given.copy_from_slice(&self.initial[..given.len()]);
                rest.fill(0);
            }
        }
    }
}

impl ParameterLayout {
    /// A view's block with every node's initial values.
    #[must_use]
    pub fn initial(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.size as usize];
        for block in &self.blocks {
            (0..block.count).for_each(|layer| block.reset(&mut bytes, layer, 0));
        }
        for table in &self.regions {
            (0..table.layers).for_each(|layer| table.reset(&mut bytes, layer));
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
    ) -> Result<(), ParameterError> {
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
    ) -> Result<(), ParameterError> {
        let planned = self
            .blocks
            .iter()
            .find(|planned| planned.node == node)
            .ok_or_else(|| ParameterError::UnknownNode {
                node: node.to_owned(),
                known: self
                    .blocks
                    .iter()
                    .map(|planned| planned.node.as_str())
                    .collect::<Vec<_>>()
                    .join(", "),
            })?;
        if size_of::<P>() != planned.size as usize {
            return Err(ParameterError::Size {
                node: node.to_owned(),
                name: planned.name.clone(),
                expected: planned.size,
                given: size_of::<P>(),
            });
        }
        if parameters.len() > planned.elements as usize {
            return Err(ParameterError::Elements {
                node: node.to_owned(),
                name: planned.name.clone(),
                elements: planned.elements,
                given: parameters.len(),
            });
        }
        if layer >= planned.count {
            return Err(ParameterError::Layer {
                node: node.to_owned(),
                count: planned.count,
                layer,
            });
        }
        let given = block.len();
        let start = planned.start(layer, 0);
        let array = block
            .get_mut(start..start + planned.array_size() as usize)
            .ok_or(ParameterError::Block {
                expected: self.size,
                given,
            })?;
        let bytes: &[u8] = bytemuck::cast_slice(parameters);
        array[..bytes.len()].copy_from_slice(bytes);
        planned.reset(block, layer, parameters.len() as u32);
        Ok(())
    }
}
