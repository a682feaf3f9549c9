//! Nodes that fit ranges to what a camera sees of each region.

use moment_shadows::{LeakReduction, LightView, ReceiverBias, ViewParameters};

use super::scratch::Told;
use super::unsuitable;
use crate::nodes::SEES;
use crate::{GraphError, Plan};

/// A node that fits ranges to what a camera sees.
#[derive(Debug)]
pub(super) struct Seen {
    pub(super) node: String,
    pub(super) layers: u32,
}

impl Seen {
    /// Those of a plan.
    pub(super) fn all(plan: &Plan) -> Vec<Self> {
        let passes = plan.passes.iter().filter(|pass| pass.label == SEES);
        let of = passes.filter_map(|pass| {
            let mut blocks = plan.parameters.blocks.iter();
            let block = blocks.find(|block| block.node == pass.node)?;
            (block.name == "ViewParameters").then(|| Self {
                node: block.node.clone(),
                layers: block.count,
            })
        });
        of.collect()
    }

    /// The structs of a layer's views.
    pub(super) fn write<'a>(
        &self,
        views: &mut Vec<ViewParameters>,
        told: &Told<'_>,
        lights: impl Iterator<Item = (usize, &'a LightView)>,
    ) -> Result<(), GraphError> {
        views.clear();
        for (index, light) in lights {
            let made =
                ViewParameters::new(told.camera, light, ReceiverBias::NONE, LeakReduction::NONE);
            views.push(made.map_err(|error| {
                let what = format_args!("view {index} of a light, for node '{}'", self.node);
                unsuitable(what, error)
            })?);
        }
        Ok(())
    }
}
