//! Turns a filtered map and the camera's depth into shadow intensity on the screen.

use moment_shadows::{MapEncoding, Technique, TextureFormat};
use serde::Deserialize;

use super::shared::debug_view::DebugView;
use super::shared::lookup::moments_lookup;
use super::shared::{
    Specialization, depth_input, map_input, range_input, shading, wrong_format, wrong_property,
};
use super::techniques;
use crate::{
    Binding, BindingResource, Capabilities, Connected, GraphError, Node, NodeDesc, Slot,
    TextureDesc, bind,
};

mod own_shader;

/// Node `shade_hard`: `map` (a filtered map) and `camera_depth` to `shadow_intensity`, of the camera's size. A
/// fullscreen pass, which can also be drawn into a render pass that the host has open; of more than four lights a compute pass. Techniques that read the plain depth map
/// take it as the input `depth` instead of `map`; layers that are placed on the device come from the input `splits`, and what a
/// map's depths are fitted to from the input `ranges` ([`super::FitRange`]).
///
/// It shades up to 16 lights, one in each channel of its outputs, through up to 256 views: cascades, faces and spots, each a region
/// of a layer. A single light is in all channels; lights 4 to 7 are in `shadow_intensity_4`, and so on. Parameters: a [`moment_shadows::ViewParameters`] per view.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct ShadeHard {
    /// How the map becomes shadow intensity. Where it is left out, that which the map was made for.
    pub technique: Option<Technique>,
    /// The format of the shadow intensity, with a channel for each light: r8unorm, r16float or
    /// r32float for one, rgba8unorm, rgba16float or rgba32float for more, four in each output. Where it is left out, r8unorm or
    /// rgba8unorm.
    pub format: Option<TextureFormat>,
    /// The lights, 1 to 16: four in each output.
    pub lights: u32,
    /// The most views of all lights together, at most 256. From 8 on, a pixel tries those alone that may contain it: a pass finds them
    /// for each tile of 16x16 pixels.
    pub views: u32,
    /// Whether views blend and fade out along their borders ([`moment_shadows::Border`]), for a few more instructions per view.
    /// Otherwise borders are sharp.
    pub borders: bool,
    /// What the output `debug` shows of how pixels are shaded; without it there is no such output.
    pub debug: Option<DebugView>,
    /// The most probes of a lookup in a map with mip levels, 1 to 16: 1 is a trilinear lookup, more follow the direction
    /// in which a pixel covers more texels.
    pub anisotropy: u16,
}

impl Default for ShadeHard {
    fn default() -> Self {
        Self {
            technique: None,
            format: None,
            lights: 1,
            views: 1,
            borders: false,
            debug: None,
            // What hardware commonly takes at little cost.
            anisotropy: 8,
        }
    }
}

impl Node for ShadeHard {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let moments = || map_input::connected(upstream, "map");
        let evaluation = self.evaluation(upstream.capabilities(), moments)?;
        let rule = map_input::rule(evaluation.formats);
        let input = Slot::input(evaluation.slot, "The light's map.", rule);
        let (splits, splits_binding) = techniques::splits(&evaluation.technique, false);
        let specialization = evaluation.specialization;
        let (specialization, ranges, ranges_binding) = match evaluation.slot {
            "map" => {
                let map = upstream.texture("map")?;
                let (all, slot, binding) = range_input::of_reader(specialization, upstream, map)?;
                (all, Some(slot), binding)
            }
            _ => (range_input::none(specialization), None, None),
        };
        shading::describe(
            "shade_hard",
            upstream,
            shading::Settings {
                format: self.format,
                lights: self.lights,
                views: self.views,
                borders: self.borders,
                debug: self.debug,
            },
            (&evaluation.technique, false),
            core::iter::once(input).chain(splits).chain(ranges),
            (evaluation.bindings.into_iter())
                .chain(splits_binding)
                .chain(ranges_binding)
                .collect(),
            specialization,
        )
    }
}

/// A technique with the map that it reads.
pub(super) struct Evaluation {
    pub(super) technique: Technique,
    /// What a shader imports that evaluates the technique.
    pub(super) specialization: Specialization,
    pub(super) slot: &'static str,
    pub(super) formats: Vec<TextureFormat>,
    /// The map and its sampler, if it has one.
    pub(super) bindings: Vec<Binding>,
}

impl ShadeHard {
    /// The technique on the map that it reads: `map`, or the plain depth map.
    pub(super) fn evaluation<'a>(
        &self,
        capabilities: &Capabilities,
        moments: impl FnOnce() -> Result<(&'a TextureDesc, MapEncoding), GraphError>,
    ) -> Result<Evaluation, GraphError> {
        let probes = self.anisotropy;
        if !(1..=16).contains(&probes) {
            return Err(wrong_property(format!(
                "'anisotropy' is {probes}; it is from 1 (trilinear lookups) to 16"
            )));
        }
        let given = self.technique.as_ref();
        given
            .map_or(Ok(()), Technique::check)
            .map_err(wrong_property)?;
        let specialization = Specialization::new(capabilities);
        if let Some(technique) = given.filter(|technique| technique.reads_depth()) {
            let specialization = specialization
                .constant("LEVELS", "1u")
                .constant("ANISOTROPY", "1.0");
            let sampler = technique.row().comparison.map(|reversed| {
                let resource = BindingResource::ComparisonSampler { reversed };
                Binding::new("comparison_sampler", resource)
            });
            let map = Binding::new("depth_map", bind::layers("depth"));
            return Ok(Evaluation {
                technique: technique.clone(),
                specialization: techniques::evaluation(specialization, technique, None),
                slot: "depth",
                formats: depth_input::FORMATS.to_vec(),
                bindings: [Some(map), sampler].into_iter().flatten().collect(),
            });
        }
        let (map, encoding) = moments()?;
        let made_for = encoding.technique();
        let technique = given.map_or(made_for.clone(), |it| it.clone().on_map_of(made_for));
        let is_read = MapEncoding::new(technique.clone(), encoding.storage()).is_ok();
        if !is_read || !technique.row().shares_map_with(&made_for.row()) {
            let message = format!(
                "the map was made for {encoding}, with its settings; '{technique}' cannot read it: give the node that makes it \
                 the same 'technique', or leave it out here"
            );
            return Err(wrong_format(message).at_slot("map"));
        }
        if encoding.is_rounded_inwards() && technique.row().rounded_inwards_technique().is_none() {
            let message = format!(
                "the blur that resolves makes the map for '{made_for}', whose moments are then valid for that alone; '{technique}' cannot read it: \
                 give that blur the technique '{technique}', or put a node 'resolve' and a blur of its map in its place"
            );
            return Err(wrong_format(message).at_slot("map"));
        }
        let specialization = specialization.unsigned("STORAGE", encoding.storage().wgsl_index());
        let specialization = techniques::evaluation(specialization, &technique, Some(&encoding));
        let (specialization, sampler) =
            moments_lookup(specialization, capabilities, &encoding, map.mips, probes);
        let map = Binding::new("moments_map", bind::layers("map"));
        Ok(Evaluation {
            technique,
            specialization,
            slot: "map",
            formats: map_input::all_formats(),
            bindings: [Some(map), sampler].into_iter().flatten().collect(),
        })
    }
}
