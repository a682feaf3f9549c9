//! Light that any medium scatters into each pixel's view ray, of any light.

mod best;

use moment_shadows::TextureFormat::{self, Rgba16Float, Rgba32Float};
use moment_shadows::{AirLight, MarchScatteringParameters, Resolution, Technique};
use serde::Deserialize;

use super::ShadeHard;
use super::shared::{depth_input, map_input, range_input, wgsl, wrong_property};
use super::techniques;
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, Slot, Stage, TextureRule,
    bind,
};

/// Node `march_scattering`: `map` (a filtered map) and `camera_depth` to `scattering`: in-scattered radiance in red, green and
/// blue, and in alpha the mean of the colours' transmittance between camera and surface, as [`super::CompositeScattering`] has
/// them. It marches view rays with one lookup of the map per step, so that the light can be a sun, a spot or a point light, and the
/// density of the medium anything. Techniques that read the plain depth map take it as the input `depth` instead of `map`. A
/// fullscreen pass: at full resolution it can also be drawn into a render pass that the host has open. Parameters: a
/// [`MarchScatteringParameters`] per view of the light.
///
/// Its views may be cascades, a spot's or a point light's faces; of those that contain a point the first one counts, and what none
/// contains is lit. A medium without density, or with parameters that would give a non-finite result, gives exactly (0, 0, 0, 1).
/// Radiance is at most 65504.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct MarchScattering {
    /// How the map becomes shadow intensity. Where it is left out, that which the map was made for.
    pub technique: Option<Technique>,
    /// The format of the radiance: rgba16float or rgba32float. Where it is left out, rgba16float.
    pub format: Option<TextureFormat>,
    /// Steps of a view ray, 1 to 1024. None, or `"best"` in a file, where they are left to the library with the `resolution`: of the ways
    /// that were measured that with the least error for the `light` and the `lookups`.
    #[serde(default = "best::usual", deserialize_with = "best::steps")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "best::steps_schema", extend("default" = 16)))]
    pub steps: Option<u32>,
    /// With `"best"`: what kind of light it is.
    pub light: Option<AirLight>,
    /// With `"best"`: how many lookups of the light's map a pixel of the picture has at most.
    pub lookups: Option<f32>,
    /// The most views of the light, 1 to 16.
    pub views: u32,
    /// How much of the picture's resolution is marched, along each side; full where it is left out. The node `upsample_scattering` makes the
    /// rest.
    pub resolution: Option<Resolution>,
    /// Whether steps are shifted from pixel to pixel and from frame to frame, by blue noise: bands become noise. Otherwise the middles of
    /// steps are looked up.
    pub dithered: bool,
    /// A density of your own: WGSL with a function `density(position: vec3f, own: vec4f) -> f32`, which may import the library's
    /// modules. It is a factor of the medium's density at a position in the scene, and is told four numbers that the host gives per
    /// frame. Where it is negative or no number there is no medium.
    pub density: Option<String>,
    /// The most probes of a lookup in a map with mip levels, 1 to 16: a step looks up all that it passes.
    pub anisotropy: u16,
}

impl Default for MarchScattering {
    fn default() -> Self {
        Self {
            technique: None,
            format: None,
            steps: best::usual(),
            light: None,
            lookups: None,
            views: 1,
            resolution: None,
            dithered: true,
            density: None,
            anisotropy: 8,
        }
    }
}

/// The most views of a light: cascades, or six faces.
const MOST_VIEWS: u32 = 16;

impl MarchScattering {
    fn check(&self) -> Result<TextureFormat, GraphError> {
        let format = self.format.unwrap_or(Rgba16Float);
        if ![Rgba16Float, Rgba32Float].contains(&format) {
            return Err(wrong_property(format!(
                "radiance has no upper limit; 'format' is rgba16float or rgba32float, not {format}"
            )));
        }
        if !(1..=MOST_VIEWS).contains(&self.views) {
            return Err(wrong_property(format!(
                "'views' is {}; a light has 1 to {MOST_VIEWS} here",
                self.views
            )));
        }
        Ok(format)
    }
}

impl Node for MarchScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = self.check()?;
        let (steps, resolution) = self.chosen()?;
        let lookup = ShadeHard {
            technique: self.technique.clone(),
            anisotropy: self.anisotropy,
            ..ShadeHard::default()
        };
        let moments = || map_input::connected(upstream, "map");
        let evaluation = lookup.evaluation(upstream.capabilities(), moments)?;
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
        let camera = upstream.texture("camera_depth")?;
        let per_texel = resolution.pixels_per_texel();
        let of_fog = include_str!("density_of_fog.wgsl").to_owned();
        let specialization = depth_input::of_camera(specialization, camera)
            .unsigned("VIEWS", self.views)
            .unsigned("STEPS", steps)
            .unsigned("PER_TEXEL", per_texel)
            .constant("DITHERED", self.dithered)
            .constant("OWN_DENSITY", self.density.is_some())
            .module("density", self.density.clone().unwrap_or(of_fog))
            .module("march_views", include_str!("march_views.wgsl"))
            .module("air_shadow", include_str!("air_shadow.wgsl"));
        let mut pass = Pass::fullscreen("march", "scattering")
            .shader(
                specialization.link(wgsl!("march_scattering.wgsl"))?,
                "march",
            )
            .bind("views", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"));
        let bindings = evaluation.bindings.into_iter();
        pass.bindings
            .extend(bindings.chain(splits_binding).chain(ranges_binding));
        let map = Slot::input(
            evaluation.slot,
            "The light's map.",
            map_input::rule(evaluation.formats),
        );
        let radiance = TextureRule::new(format).tiles_of("camera_depth", [per_texel; 2]);
        let description = "In-scattered radiance, and in alpha the transmittance to the surface.";
        Ok(NodeDesc::new("march_scattering", Stage::AfterMainPass)
            .slots(core::iter::once(map).chain(splits).chain(ranges))
            .input("camera_depth", "Where surfaces are.", depth_input::camera())
            .output("scattering", description, radiance)
            .pass(pass)
            .parameters(
                ParameterBlock::of::<MarchScatteringParameters>("MarchScatteringParameters")
                    .elements(self.views),
            )
            // Nothing in the air: no light is added, and all of it comes through.
            .off("scattering", Off::Fill(vec![[0.0, 0.0, 0.0, 1.0]])))
    }
}
