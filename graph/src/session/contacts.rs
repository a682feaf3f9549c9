//! What nodes that find shadows at contacts are told of lights.

use moment_shadows::ContactShadowParameters;

use super::cut::{owner, slot};
use super::scratch::Told;
use super::unsuitable;
use crate::{Graph, GraphError, Plan};

/// A node that finds shadows at contacts.
#[derive(Debug)]
pub(super) struct Contacts {
    pub(super) node: String,
    /// The light of its first channel: that of the output which it darkens.
    first: u32,
    lights: u32,
}

impl Contacts {
    /// Those of a plan.
    pub(super) fn all(graph: &Graph, plan: &Plan) -> Vec<Self> {
        let blocks = plan.parameters.blocks.iter();
        let blocks = blocks.filter(|block| block.name == "ContactShadowParameters");
        let of = blocks.map(|block| {
            let mut edges = graph.edges.iter();
            let edge =
                edges.find(|edge| owner(&edge.to) == block.node && slot(&edge.to) == "intensity");
            let number = edge.and_then(|edge| slot(&edge.from).strip_prefix("shadow_intensity_"));
            Self {
                node: block.node.clone(),
                first: number.and_then(|it| it.parse().ok()).unwrap_or(0),
                lights: block.elements,
            }
        });
        of.collect()
    }

    /// The structs, one for each light: the first view of each says where it is.
    pub(super) fn write(
        &self,
        told: &Told<'_>,
        contacts: &mut Vec<ContactShadowParameters>,
    ) -> Result<(), GraphError> {
        contacts.clear();
        let mut found = [None; 4];
        for (index, light) in told.lights.iter().enumerate() {
            let what = || format!("view {index} of a light, for node '{}'", self.node);
            let Some(channel) = light.channel.checked_sub(self.first).filter(|it| *it < 4) else {
                // Of another output.
                continue;
            };
            if channel >= self.lights {
                let reason = format!(
                    "its channel is {}, but the node has {} of the lights; give it as many 'lights' as its 'intensity' has",
                    light.channel, self.lights
                );
                return Err(unsuitable(what(), reason));
            }
            let of_channel = &mut found[channel as usize];
            if of_channel.is_none() {
                let made = ContactShadowParameters::new(told.camera, light, told.contact);
                *of_channel = Some(made.map_err(|error| unsuitable(what(), error))?);
            }
        }
        // A channel without a light is as it was.
        if let Some(any) = found.iter().flatten().next() {
            let none = any.without_light();
            let all = found.iter().take(self.lights as usize);
            contacts.extend(all.map(|of_channel| of_channel.unwrap_or(none)));
        }
        Ok(())
    }
}
