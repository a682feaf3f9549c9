//! Users' shaders that shade with a technique as the node does.

use super::super::shared::map_input;
use super::super::techniques;
use super::ShadeHard;
use crate::compile::binding_numbers;
use crate::{BindingResource, Capabilities, GraphError, TextureDesc};

/// A linked shader, and what it binds beside its own.
#[derive(Clone, Debug, PartialEq)]
pub struct TechniqueShader {
    /// The text, with all that it imports.
    pub wgsl: String,
    /// The map and its sampler, if it has one, by binding number in the bind group of the capabilities.
    pub bindings: Vec<(u32, BindingResource)>,
}

impl ShadeHard {
    /// Links a user's shader with the technique that this node evaluates a map with, by the same text: one that
    /// shades other points than the pixels of a picture.
    ///
    /// Besides the library's modules the shader imports `technique_shadow_intensity` from `node::technique`, which
    /// takes a `TechniqueReceiver` (`node::technique_receiver`); `technique_map_size` from
    /// `node::technique_map`; for filterable maps `map_texel` from `node::map_texel`; and what it brings
    /// along in `modules`, by name and text. Its own bindings lie in another group than `capabilities.bind_group`, or are 0,
    /// 1, 4 and above. `map` is the light's map: the plain depth map for techniques that read it. `file` names the shader in
    /// errors. Layers that are placed on the device are refused.
    pub fn link_shader(
        &self,
        map: &TextureDesc,
        capabilities: &Capabilities,
        file: &str,
        shader: &str,
        modules: &[(&str, &str)],
    ) -> Result<TechniqueShader, GraphError> {
        let moments = || {
            Ok((
                map,
                map_input::encoding_of(map).map_err(|error| error.at_slot("map"))?,
            ))
        };
        let (technique, map) = self.technique_and_map(capabilities, moments)?;
        if techniques::places_layers(&technique) {
            return Err(techniques::property(
                "layers that are placed on the device are known to the graph alone; give the splits, or take uniform ones",
            ));
        }
        let (specialization, adapters) = self.evaluation(&technique, &map, capabilities);
        let all: Vec<(&str, &str)> = adapters
            .into_iter()
            .chain(modules.iter().copied())
            .collect();
        let wgsl = specialization.link((file, shader), &all)?;
        let numbers = binding_numbers(&wgsl)?;
        let bindings = map.bindings().into_iter();
        let numbered =
            |binding: crate::Binding| Some((*numbers.get(&binding.variable)?, binding.resource));
        Ok(TechniqueShader {
            bindings: bindings.filter_map(numbered).collect(),
            wgsl,
        })
    }
}
