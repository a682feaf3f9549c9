//! Turns a filtered map and the camera's depth into shadow intensity on the screen.

use moment_shadows::{MapEncoding, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::shared::lookup::{self, moments_lookup};
use super::shared::{DEPTHS, FULLSCREEN, Specialization, VirtualModule, map_input, shading};
use super::techniques;
use crate::{
    Binding, BindingResource, Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc,
    Slot, TextureDesc, bind,
};

mod own_shader;

pub use own_shader::TechniqueShader;

/// Node `shade_hard`: `map` (a filtered map) and `camera_depth` to `shadow_intensity`, of the camera's size. A
/// fullscreen pass: it can also be drawn into a render pass that the host has open. Techniques that read the plain depth map
/// take it as the input `depth` instead of `map`; layers that are placed on the device come from the input `splits`.
///
/// It shades up to four lights, one in each channel of its output (a single one is in all of them), through any number of
/// views: cascades, faces and spots, each a region of a layer. Parameters: an array of [`moment_shadows::ViewParameters`], one per view. Where the map has mip
/// levels, lookups average the texels that a pixel covers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShadeHard {
    /// How the map becomes shadow intensity. Where it is left out, that which the map was made for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub technique: Option<Technique>,
    /// The format of the shadow intensity, with at least as many channels as there are lights: r8unorm, r16float or
    /// r32float for one, rgba8unorm, rgba16float or rgba32float for up to four. Where it is left out, r8unorm or
    /// rgba8unorm.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<TextureFormat>,
    /// The lights, 1 to 4.
    #[serde(default = "one")]
    pub lights: u32,
    /// The most views of all lights together.
    #[serde(default = "one")]
    pub views: u32,
    /// The most probes of a lookup in a map with mip levels, 1 to 16: 1 is a trilinear lookup, more follow the direction
    /// in which a pixel covers more texels.
    #[serde(default = "default_anisotropy")]
    pub anisotropy: u16,
}

fn one() -> u32 {
    1
}

/// The number of probes that hardware commonly takes at little cost.
fn default_anisotropy() -> u16 {
    8
}

impl Default for ShadeHard {
    fn default() -> Self {
        Self {
            technique: None,
            format: None,
            lights: 1,
            views: 1,
            anisotropy: default_anisotropy(),
        }
    }
}

impl Node for ShadeHard {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = self.check()?;
        let capabilities = upstream.capabilities();
        let (technique, map) =
            self.technique_and_map(capabilities, || map_input::connected(upstream, "map"))?;
        let (specialization, mut modules) = self.evaluation(&technique, &map, capabilities);
        modules.push(FULLSCREEN);
        let wgsl = specialization.link(shading::SHADER, &modules)?;
        let rule = map_input::rule(map.formats);
        let input = Slot::input(map.slot, "The light's map.", rule);
        let splits = techniques::places_layers(&technique).then(|| techniques::splits_input(false));
        let (splits, splits_binding) = splits.unzip();
        Ok(shading::describe(
            "shade_hard",
            core::iter::once(input).chain(splits),
            map.bindings().into_iter().chain(splits_binding),
            format,
            self.views,
            wgsl,
        ))
    }
}

/// The map that is shaded with.
struct Map {
    slot: &'static str,
    formats: &'static [TextureFormat],
    /// The shader's variable.
    variable: &'static str,
    /// The storage's number in WGSL, of a filterable map.
    storage: Option<u32>,
    levels: u32,
    lookup: VirtualModule,
    sampler: Option<Binding>,
}

impl Map {
    /// The map and its sampler, if there is one.
    fn bindings(&self) -> Vec<Binding> {
        let map = Binding::new(self.variable, bind::layers(self.slot));
        core::iter::once(map).chain(self.sampler.clone()).collect()
    }
}

impl ShadeHard {
    /// What a shader imports that evaluates a technique: the generated module and the technique's adapters.
    fn evaluation(
        &self,
        technique: &Technique,
        map: &Map,
        capabilities: &Capabilities,
    ) -> (Specialization, Vec<VirtualModule>) {
        let mut specialization = Specialization::new(capabilities)
            .unsigned("LEVELS", map.levels)
            .unsigned("VIEWS", self.views)
            .unsigned("LIGHTS", self.lights)
            .constant("ANISOTROPY", &format!("{}.0", self.anisotropy))
            .unsigned("PLANES", technique.planes());
        if let Some(storage) = map.storage {
            specialization = specialization.unsigned("STORAGE", storage);
        }
        let (specialization, mut modules) = techniques::evaluation(specialization, technique);
        modules.push(map.lookup);
        (specialization, modules)
    }

    /// The technique, and the map that it reads: `map`, or the plain depth map.
    fn technique_and_map<'a>(
        &self,
        capabilities: &Capabilities,
        moments: impl FnOnce() -> Result<(&'a TextureDesc, MapEncoding), GraphError>,
    ) -> Result<(Technique, Map), GraphError> {
        if let Some(technique) = &self.technique {
            technique.check().map_err(techniques::property)?;
            if technique.reads_depth() {
                return Ok((technique.clone(), depth_map(technique)));
            }
        }
        let (moments, encoding) = moments()?;
        let made_for = encoding.technique();
        let technique = self.technique.as_ref().unwrap_or(made_for);
        if !technique.shares_map_with(made_for) {
            return Err(GraphError::new(
                GraphErrorKind::Format,
                format!(
                    "the map was made for '{made_for}', with its settings; '{technique}' cannot read it: give the node that \
                     makes it the same 'technique', or leave it out here"
                ),
            )
            .at_slot("map"));
        }
        let logarithmic = techniques::is_logarithmic(technique);
        let (lookup, sampler) = moments_lookup(
            moments.format,
            moments.mips,
            self.anisotropy,
            !logarithmic,
            capabilities,
        );
        let map = Map {
            slot: "map",
            formats: &map_input::FORMATS,
            variable: "moments_map",
            storage: Some(encoding.storage().wgsl_index()),
            // Logarithms have no mip levels.
            levels: if logarithmic { 1 } else { moments.mips },
            lookup,
            sampler,
        };
        Ok((technique.clone(), map))
    }

    /// Checks the properties and gives the format of the output.
    fn check(&self) -> Result<TextureFormat, GraphError> {
        if !(1..=16).contains(&self.anisotropy) {
            return Err(techniques::property(format!(
                "'anisotropy' is {}; it is from 1 (trilinear lookups) to 16",
                self.anisotropy
            )));
        }
        shading::target_format(self.format, self.lights, self.views)
    }
}

/// The plain depth map.
fn depth_map(technique: &Technique) -> Map {
    let sampler = technique.row().comparison.map(|reversed| {
        let resource = BindingResource::ComparisonSampler { reversed };
        Binding::new("comparison_sampler", resource)
    });
    Map {
        slot: "depth",
        formats: &DEPTHS,
        variable: "depth_map",
        storage: None,
        levels: 1,
        lookup: lookup::LOADED,
        sampler,
    }
}
