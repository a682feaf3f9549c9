//! Uniform data: where each node's lies in the block of a view, and writing it there.

use serde::{Deserialize, Serialize};

/// Where uniform data lies in the block of one view. A host keeps one block per view in a buffer of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterLayout {
    /// Bytes of one view's block; blocks of several views follow each other at multiples of this.
    pub size: u32,
    /// The blocks of the nodes.
    pub blocks: Vec<PlannedParameters>,
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
    /// Bytes from one layer's struct to the next.
    pub stride: u32,
    /// How many structs there are: one, or one per layer.
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
    /// Where the struct of a layer begins in the view's block.
    fn start(&self, layer: u32) -> usize {
        self.offset as usize + layer as usize * self.stride as usize
    }
}

impl ParameterLayout {
    /// A view's block with every node's initial values.
    #[must_use]
    pub fn initial(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.size as usize];
        for block in &self.blocks {
            for index in 0..block.count {
                let start = block.start(index);
                if let Some(place) = bytes.get_mut(start..start + block.initial.len()) {
                    place.copy_from_slice(&block.initial);
                }
            }
        }
        bytes
    }

    /// Writes a node's struct (for `layer`, where there is one per layer) into a view's block.
    pub fn write<P: bytemuck::NoUninit>(
        &self,
        block: &mut [u8],
        node: &str,
        layer: u32,
        parameters: &P,
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
        let bytes = bytemuck::bytes_of(parameters);
        if bytes.len() != planned.size as usize {
            return Err(ParameterError::Size {
                node: node.to_owned(),
                name: planned.name.clone(),
                expected: planned.size,
                given: bytes.len(),
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
        let start = planned.start(layer);
        block
            .get_mut(start..start + bytes.len())
            .ok_or(ParameterError::Block {
                expected: self.size,
                given,
            })?
            .copy_from_slice(bytes);
        Ok(())
    }
}
