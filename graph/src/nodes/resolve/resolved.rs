//! What a node takes that resolves a depth map: the input, its conversions, ranges and splits.

use moment_shadows::MapEncoding;

use super::Resolve;
use crate::nodes::shared::{Specialization, depth_input, range_input, wrong_property};
use crate::nodes::techniques;
use crate::{Binding, Connected, GraphError, ParameterBlock, Slot, TextureDesc, TextureRule, bind};

/// A depth map as a shader resolves it.
pub(in crate::nodes) struct Resolved<'a> {
    pub(in crate::nodes) depth: &'a TextureDesc,
    pub(in crate::nodes) encoding: MapEncoding,
    /// How what the shader writes is encoded.
    pub(in crate::nodes) written: MapEncoding,
    /// The module `resolved` and what it imports.
    pub(in crate::nodes) specialization: Specialization,
    inputs: Vec<Slot>,
    bindings: Vec<Binding>,
}

impl Resolve {
    /// The depth map that is connected to the node, for a map of this encoding and a shader that writes texels as `written` gives it for one.
    pub(in crate::nodes) fn resolved<'a>(
        &self,
        upstream: &Connected<'a>,
        encoding: MapEncoding,
        written: impl FnOnce(&MapEncoding) -> MapEncoding,
    ) -> Result<Resolved<'a>, GraphError> {
        let depth = upstream.texture("depth")?;
        let technique = encoding.technique();
        let written = written(&encoding);
        let specialization = techniques::of_map(upstream.capabilities(), &written);
        let (specialization, ranges, ranges_binding) =
            range_input::of_maker(specialization, upstream, depth)?;
        if ranges_binding.is_some() && technique.row().places_layers {
            let message = "the layers of the technique are placed in the host's range; give the splits, or leave this input open";
            return Err(wrong_property(message).at_slot("ranges"));
        }
        let specialization = specialization
            .alias("DepthTexture", depth_input::texture_type(depth))
            .unsigned("REGIONS", depth.regions)
            .constant("SAMPLES", depth.samples)
            .module("technique_layers", techniques::layers(technique, true))
            .module("resolved", include_str!("resolved.wgsl"));
        let (splits, splits_binding) = techniques::splits(technique, true);
        let own = [
            Binding::new("conversions", bind::parameters()),
            Binding::new("depth_map", bind::layer("depth")),
        ];
        Ok(Resolved {
            depth,
            encoding,
            written,
            specialization,
            inputs: splits.into_iter().chain([ranges]).collect(),
            bindings: own
                .into_iter()
                .chain(splits_binding)
                .chain(ranges_binding)
                .collect(),
        })
    }
}

impl Resolved<'_> {
    /// The inputs: the depth map, and what comes beside it.
    pub(in crate::nodes) fn inputs(&self) -> impl Iterator<Item = Slot> {
        let depth = Slot::input("depth", "The light's depth map.", depth_input::light());
        [depth].into_iter().chain(self.inputs.clone())
    }

    /// What the module's variables hold.
    pub(in crate::nodes) fn bindings(&self) -> impl Iterator<Item = Binding> {
        self.bindings.clone().into_iter()
    }

    /// The map that is made of it.
    pub(in crate::nodes) fn map(&self) -> TextureRule {
        TextureRule::of_map(self.encoding.clone())
            .like("depth")
            .fitted_to("ranges")
    }

    /// How its depths are stored.
    pub(in crate::nodes) fn conversions(&self) -> ParameterBlock {
        depth_input::conversions(self.depth)
    }
}
