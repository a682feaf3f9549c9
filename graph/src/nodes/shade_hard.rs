//! Turns a filtered map and the camera's depth into shadow intensity on the screen.

use moment_shadows::{MapEncoding, PcfTaps, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::moments_input::{map_formats, moments_input};
use super::moments_lookup::moments_lookup;
use super::shading;
use super::specialization::{FULLSCREEN, Specialization};
use super::techniques::{self, VirtualModule};
use crate::{
    Binding, BindingResource, Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc,
    TextureDesc,
};

mod own_shader;

pub use own_shader::TechniqueShader;

/// Node `shade_hard`: `moments` (a filtered map) and `camera_depth` to `shadow_intensity`, of the camera's size. A
/// fullscreen pass: it can also be drawn into a render pass that the host has open. Techniques that read the plain depth map
/// take it as the input `depth` instead of `moments`; layers that are placed on the device come from the input `splits`.
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
    /// Some samples multiply moments by a constant. Refused: the result bounds nothing.
    #[serde(default, skip_serializing)]
    pub moment_scale: Option<f32>,
}

fn one() -> u32 {
    1
}

/// As many probes as hardware commonly takes at little cost.
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
            moment_scale: None,
        }
    }
}

impl Node for ShadeHard {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = self.check()?;
        let capabilities = upstream.capabilities();
        let (technique, map) = self.technique_and_map(capabilities, || moments_input(upstream))?;
        let (specialization, mut modules) = self.evaluation(&technique, &map, capabilities);
        modules.push(FULLSCREEN);
        let wgsl = specialization.link("shade.wgsl", shading::SHADER, &modules)?;
        let mut bindings = vec![
            Binding {
                binding: 0,
                resource: BindingResource::Parameters,
            },
            Binding {
                binding: 1,
                resource: BindingResource::Layer("camera_depth".to_owned()),
            },
        ];
        bindings.extend(map.bindings());
        let splits = techniques::places_layers(&technique).then(|| techniques::splits_input(false));
        bindings.extend(splits.iter().map(|(_, binding)| binding.clone()));
        Ok(shading::describe(
            "shade_hard",
            shading::ShadedMap {
                slot: map.slot,
                formats: map.formats,
            },
            format,
            self.views,
            wgsl,
            bindings,
            splits.map(|(slot, _)| slot).into_iter().collect(),
        ))
    }
}

/// The map that is shaded with.
struct Map {
    slot: &'static str,
    formats: Vec<TextureFormat>,
    /// The storage's number in WGSL, of a filterable map.
    storage: Option<u32>,
    levels: u32,
    lookup: &'static str,
    sampler: Option<BindingResource>,
}

impl Map {
    /// The map and its sampler, if there is one.
    fn bindings(&self) -> Vec<Binding> {
        let map = Binding {
            binding: 2,
            resource: BindingResource::Layers(self.slot.to_owned()),
        };
        let sampler = self.sampler.clone().map(|resource| Binding {
            binding: 3,
            resource,
        });
        core::iter::once(map).chain(sampler).collect()
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
            .constant("LEVELS", &format!("{}u", map.levels))
            .constant("VIEWS", &format!("{}u", self.views))
            .constant("LIGHTS", &format!("{}u", self.lights))
            .constant("ANISOTROPY", &format!("{}.0", self.anisotropy))
            .constant("PLANES", &format!("{}u", technique.planes()));
        if let Some(storage) = map.storage {
            specialization = specialization.constant("STORAGE", &format!("{storage}u"));
        }
        let mut modules = techniques::evaluation(technique);
        modules.push(("moments_lookup", map.lookup));
        (techniques::specialize(specialization, technique), modules)
    }

    /// The technique, and the map that it reads: `moments`, or the plain depth map.
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
            formats: map_formats(),
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
        let property = |message: String| Err(GraphError::new(GraphErrorKind::Property, message));
        if self.moment_scale.is_some() {
            return property(
                "'moment_scale' is refused: moments times a constant are the moments of no distribution, so that the result \
                 bounds nothing; use the leak reduction of the node's parameters instead"
                    .to_owned(),
            );
        }
        if !(1..=16).contains(&self.anisotropy) {
            return property(format!(
                "'anisotropy' is {}; it is from 1 (trilinear lookups) to 16",
                self.anisotropy
            ));
        }
        shading::target_format(self.format, self.lights, self.views)
    }
}

/// The plain depth map.
fn depth_map(technique: &Technique) -> Map {
    Map {
        slot: "depth",
        formats: vec![TextureFormat::Depth32Float, TextureFormat::Depth16Unorm],
        storage: None,
        levels: 1,
        lookup: include_str!("moments_lookup_loaded.wgsl"),
        sampler: match technique {
            Technique::Pcf(PcfTaps::Hardware { reversed, .. }) => {
                Some(BindingResource::ComparisonSampler {
                    reversed: *reversed,
                })
            }
            _ => None,
        },
    }
}
