//! What can go wrong between a plan and a device.

use crate::{PlanError, Stage};

/// Why something was not created or not recorded. Nothing half-made is left.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RecordError {
    /// The device refused.
    #[error("the device could not create {what}: {reason}")]
    Device {
        /// The object's label.
        what: String,
        /// What the device said.
        reason: String,
    },
    /// The device was lost or destroyed.
    #[error("the device was lost; open a new one and create everything anew")]
    Lost,
    /// The plan does not hold together: it was read from elsewhere.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The plan was compiled for a device that takes other offsets of uniform buffers.
    #[error(
        "the parameters of node '{node}' lie at multiples of {spacing} bytes, but this device takes multiples of \
         {alignment}; compile the graph for this device"
    )]
    Alignment {
        /// The node.
        node: String,
        /// The plan's spacing.
        spacing: u32,
        /// The device's alignment.
        alignment: u32,
    },
    /// The memory is full.
    #[error(
        "the device has no memory left for {what}; use smaller maps or a storage with fewer bits"
    )]
    OutOfMemory {
        /// The object's label.
        what: String,
    },
    /// An import of the plan was not given.
    #[error("import '{name}' is missing; bind it as the plan describes it: {expected}")]
    MissingImport {
        /// The import.
        name: String,
        /// The plan's description.
        expected: String,
    },
    /// An import differs from what the plan was compiled for.
    #[error(
        "import '{name}' is {given}, but the plan was compiled for {expected}; compile the graph for what is bound"
    )]
    WrongImport {
        /// The import.
        name: String,
        /// The plan's description.
        expected: String,
        /// What was given.
        given: String,
    },
    /// The pipelines were made for another plan.
    #[error("pass '{pass}' has no pipeline; extend the pipelines with this plan first")]
    MissingPipeline {
        /// `node/pass`.
        pass: String,
    },
    /// The resources were made for another plan.
    #[error("the resources were created for another plan; create them from this one")]
    WrongResources,
    /// The parameter buffer is missing, too small, or cannot be bound as uniform data.
    #[error("the parameter buffer {problem}; a view's block has {needed} bytes")]
    ParameterBuffer {
        /// What is wrong with it.
        problem: String,
        /// Bytes of one view's block.
        needed: u64,
    },
    /// A view's block does not lie within the parameter buffer, or at an offset that the device cannot bind.
    #[error(
        "a view's parameters cannot begin at byte {offset}: offsets are multiples of {alignment}, and {needed} bytes have to \
         follow in a buffer of {size}"
    )]
    ParameterOffset {
        /// The offset.
        offset: u64,
        /// The device's alignment.
        alignment: u32,
        /// Bytes of one view's block.
        needed: u64,
        /// Bytes of the buffer.
        size: u64,
    },
    /// A map that no pass follows.
    #[error(
        "layers of map '{map}' are marked dirty, but no pass follows that map; passes follow {known}"
    )]
    NoSuchMap {
        /// The map that was named.
        map: String,
        /// The maps that passes follow.
        known: String,
    },
    /// A layer that the map does not have.
    #[error("layer {layer} is marked dirty, but pass '{pass}' has {layers} layers")]
    NoSuchLayer {
        /// The layer.
        layer: u32,
        /// `node/pass`.
        pass: String,
        /// How many there are.
        layers: u32,
    },
    /// A pass that the host has to draw, without a handler.
    #[error("stage {stage:?} has the host's pass '{pass}'; give a handler that draws it")]
    HostPass {
        /// The stage.
        stage: Stage,
        /// `node/pass`.
        pass: String,
    },
    /// The query set is too small.
    #[error("timestamps need {needed} queries from index {first}, but the query set has {count}")]
    Timestamps {
        /// The first query.
        first: u32,
        /// Queries that the plan needs.
        needed: u32,
        /// Queries in the set.
        count: u32,
    },
    /// A pass that is not a fullscreen pass of the plan.
    #[error("there is no fullscreen pass '{pass}' in the plan; it has {known}")]
    NoSuchPass {
        /// `node/pass`.
        pass: String,
        /// The plan's fullscreen passes.
        known: String,
    },
    /// A number that no pass of the plan has.
    #[error("pass number {pass} was asked for, but the plan has {count}, counted from 0")]
    NoSuchPassNumber {
        /// The number.
        pass: usize,
        /// How many passes the plan has.
        count: usize,
    },
}

impl RecordError {
    /// The error about a `pass` outside `known`, the plan's fullscreen passes.
    pub(super) fn no_such_pass<'a>(pass: &str, known: impl Iterator<Item = &'a str>) -> Self {
        let known: Vec<&str> = known.collect();
        Self::NoSuchPass {
            pass: pass.to_owned(),
            known: if known.is_empty() {
                "none".to_owned()
            } else {
                known.join(", ")
            },
        }
    }
}
