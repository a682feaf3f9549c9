//! Users' shaders that shade with a technique as the node does.

use super::super::shared::{map_input, wrong_property};
use super::ShadeHard;
use crate::compile::binding_numbers;
use crate::{Binding, BindingResource, Capabilities, GraphError, TextureDesc};

impl ShadeHard {
    /// Links a user's shader with the technique that this node evaluates a map with, by the same text: one that
    /// shades other points than the pixels of a picture. Gives the linked text, and by binding number in the bind group of the
    /// capabilities what it binds beside its own: the map and its sampler, if it has one.
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
    ) -> Result<(String, Vec<(u32, BindingResource)>), GraphError> {
        let encoding = || map_input::encoding_of(map).map_err(|error| error.at_slot("map"));
        let evaluation = self.evaluation(capabilities, || Ok((map, encoding()?)))?;
        if evaluation.technique.row().places_layers {
            return Err(wrong_property(
                "layers that are placed on the device are known to the graph alone; give the splits, or take uniform ones",
            ));
        }
        let mut specialization = evaluation.specialization;
        for &(name, text) in modules {
            specialization = specialization.module(name, text.to_owned());
        }
        let wgsl = specialization.link((file, shader))?;
        let numbers = binding_numbers(&wgsl)?;
        let bindings = evaluation.bindings.into_iter();
        let numbered =
            |binding: Binding| Some((*numbers.get(&binding.variable)?, binding.resource));
        Ok((wgsl, bindings.filter_map(numbered).collect()))
    }
}
