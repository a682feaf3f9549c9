//! Finds shadows at contacts, which maps lose, in the camera's depth.

use moment_shadows::{ContactShadowParameters, TextureFormat};
use serde::Deserialize;

use super::shared::{Specialization, depth_input, shading, wgsl, wrong_format, wrong_property};
use crate::{
    Binding, Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, ResourceDesc, Rule,
    Slot, Stage, TextureRule, bind,
};

/// Node `contact_shadows`: `camera_depth` and `intensity` (what a node that shades has made of maps) to `shadow_intensity`, of the same
/// format and size: the darker one of `intensity` and of the shadow that a short march through the camera's depth towards the light finds.
/// Without `intensity`, that march alone. A fullscreen pass: it can also be drawn into a render pass that the host has open.
///
/// It marches for up to four lights, one in each channel: those of the output that is `intensity`. A single one is in all channels, as the nodes
/// that shade have it; where that output has four, `format` says so. Parameters: a [`moment_shadows::ContactShadowParameters`] per light, with
/// the length of the march and the thickness of surfaces in scene units.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ContactShadows {
    /// The format of the shadow intensity: that of `intensity`. Where nothing is connected there, as `shade_hard` has it. It has to be given where
    /// a single light is in all four channels.
    pub format: Option<TextureFormat>,
    /// The lights, 1 to 4: as many as the node has that shades.
    pub lights: u32,
    /// The most steps of a march, 1 to 64. Steps are at least a pixel long.
    pub steps: u32,
}

impl Default for ContactShadows {
    fn default() -> Self {
        Self {
            format: None,
            lights: 1,
            steps: 16,
        }
    }
}

impl Node for ContactShadows {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let steps = self.steps;
        if !(1..=64).contains(&steps) {
            return Err(wrong_property(format!(
                "'steps' is {steps}; a march takes 1 to 64 steps"
            )));
        }
        let lights = self.lights;
        if !(1..=4).contains(&lights) {
            return Err(wrong_property(format!(
                "'lights' is {lights}; a node finds contacts of 1 to 4 lights, one per channel of its output"
            )));
        }
        let intensity = upstream.get("intensity").and_then(ResourceDesc::texture);
        let given = self.format.or(intensity.map(|intensity| intensity.format));
        let format = shading::format(given, self.lights)?;
        if let Some(intensity) = intensity
            && intensity.format != format
        {
            return Err(wrong_format(format!(
                "it is {}, but 'format' is {format}; leave 'format' out, or give the node that shades the same one",
                intensity.format
            ))
            .at_slot("intensity"));
        }
        if let Some(intensity) = intensity
            && (lights, self.format) == (1, None)
            && format.channels() > 1
        {
            // The shadow of one light would darken those of all.
            return Err(wrong_format(format!(
                "it is {}, with a channel for each of four lights, but 'lights' is 1; give as many as the node that shades has, or this 'format' if \
                 that has one as well",
                intensity.format
            ))
            .at_slot("intensity"));
        }
        let camera = upstream.texture("camera_depth")?;
        let (text, bound) = match intensity {
            Some(_) => (
                include_str!("intensity_of_maps.wgsl"),
                Some(Binding::new("intensity", bind::layer("intensity"))),
            ),
            None => (include_str!("intensity_alone.wgsl"), None),
        };
        let specialization = Specialization::new(upstream.capabilities());
        let (specialization, neighbours) = shading::surface(specialization, upstream, camera);
        let wgsl = depth_input::of_camera(specialization, camera)
            .constant(
                "DEPTH_STEP",
                format_args!("{:e}", camera.format.depth_step().unwrap_or_default()),
            )
            .unsigned("LIGHTS", self.lights)
            .unsigned("STEPS", steps)
            .module("intensity", text)
            .link(wgsl!("contact_shadows.wgsl"))?;
        let mut pass = Pass::fullscreen("contact", "shadow_intensity")
            .shader(wgsl, "contact")
            .bind("lights", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"));
        pass.bindings.extend(bound.into_iter().chain(neighbours));
        let size = || Rule::same_as("camera_depth");
        let block = ParameterBlock::of::<ContactShadowParameters>("ContactShadowParameters");
        let darker = "How much of each light is shadowed, a light per channel.";
        let of_maps = "What maps say of it, from a node that shades.";
        Ok(NodeDesc::new("contact_shadows", Stage::AfterMainPass)
            .input("camera_depth", "Where surfaces are.", depth_input::camera())
            .slots([
                Slot::input(
                    "intensity",
                    of_maps,
                    TextureRule::new(shading::formats(self.lights)).extent(size()),
                )
                .optional(),
                shading::normals_slot(),
            ])
            .output(
                "shadow_intensity",
                darker,
                TextureRule::new(format).extent(size()),
            )
            .pass(pass)
            .parameters(block.elements(self.lights))
            .off(
                "shadow_intensity",
                match intensity {
                    Some(_) => Off::Bypass("intensity".to_owned()),
                    // Lit.
                    None => Off::Fill(vec![[0.0; 4]]),
                },
            ))
    }
}
