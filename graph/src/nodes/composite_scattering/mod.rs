//! Light that a medium scatters into each pixel's view ray.

use moment_shadows::CompositeScatteringParameters;
use moment_shadows::TextureFormat::{self, Rgba16Float, Rgba32Float};
use serde::{Deserialize, Deserializer};

use super::shared::lookup::moments_lookup;
use super::shared::{depth_input, map_input, regions, wgsl, wrong_format, wrong_property};
use super::techniques;
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, Rule, Stage, TextureRule,
    bind,
};

/// Node `composite_scattering`: `integrated` (from [`super::IntegrateScattering`]) and `camera_depth` to `scattering`, of the
/// camera's size: in-scattered radiance in red, green and blue, and in alpha the mean of the colours' transmittance between
/// camera and surface. Sky is at the far distance of the parameters. A fullscreen pass: it can also be drawn into a render
/// pass that the host has open, blended as source + source alpha x destination (`HostTarget::scattered`). Parameters:
/// [`CompositeScatteringParameters`].
///
/// One texel is looked up per pixel for four moments, two for six. A medium without density, or with parameters that would give
/// a non-finite result, gives exactly (0, 0, 0, 1). Radiance is at most 65504.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct CompositeScattering {
    /// The format of the radiance: rgba16float or rgba32float. Where it is left out, rgba16float.
    pub format: Option<TextureFormat>,
    /// How strongly the shown shadow leans from the middle of its bounds to one of them, looking towards the light and away from it
    /// (in a file `towards` and `away`), each from 0, the middle, to 1, all the way.
    ///
    /// Adaptive overestimation (Peters, GDC 2016; Peters et al., JCGT 6(1) 2017, section 7): towards the light the shadow leans to
    /// its upper bound, whose error is darkness, away from it to the lower one, whose light leaks into shadow, both in proportion
    /// to the cosine of the angle between view ray and light. The published form, all the way in both, has a larger error than
    /// the default.
    #[serde(deserialize_with = "overestimation")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "overestimation_schema", extend("default" = serde_json::Value::Null)))]
    pub overestimation: [f32; 2],
}

/// Near the smallest error of every scene and view that was measured.
const OVERESTIMATION: [f32; 2] = [0.2, 0.35];

impl Default for CompositeScattering {
    fn default() -> Self {
        Self {
            format: None,
            overestimation: OVERESTIMATION,
        }
    }
}

/// A number with a name for each; those that are left out are the default.
fn overestimation<'de, D: Deserializer<'de>>(file: D) -> Result<[f32; 2], D::Error> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Written {
        towards: Option<f32>,
        away: Option<f32>,
    }
    let written = Written::deserialize(file)?;
    let [towards, away] = OVERESTIMATION;
    Ok([
        written.towards.unwrap_or(towards),
        written.away.unwrap_or(away),
    ])
}

#[cfg(feature = "schema")]
fn overestimation_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let strength = |default: f64| schemars::json_schema!({ "type": "number", "minimum": 0, "maximum": 1, "default": default });
    let [towards, away] =
        OVERESTIMATION.map(|it| strength((f64::from(it) * 100.0).round() / 100.0));
    schemars::json_schema!({
        "type": "object",
        "properties": { "towards": towards, "away": away },
        "additionalProperties": false,
    })
}

impl Node for CompositeScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = self.format.unwrap_or(Rgba16Float);
        if ![Rgba16Float, Rgba32Float].contains(&format) {
            return Err(wrong_property(format!(
                "radiance has no upper limit; 'format' is rgba16float or rgba32float, not {format}"
            )));
        }
        let [towards, away] = self.overestimation;
        for (name, strength) in [("towards", towards), ("away", away)] {
            if !(0.0..=1.0).contains(&strength) {
                return Err(wrong_property(format!(
                    "'{name}' of 'overestimation' is {strength}; it is from 0 (the middle of the bounds) to 1 (all the way to one \
                     of them)"
                )));
            }
        }
        let (_, encoding) = map_input::connected_rectified(upstream, "integrated")?;
        regions::refuse_prefix_sums(&encoding)
            .map_err(|message| wrong_format(message).at_slot("integrated"))?;
        let bounds = techniques::of_both_bounds(
            encoding.technique(),
            include_str!("bounds_four_moments.wgsl"),
            include_str!("bounds_six_moments.wgsl"),
        )
        .ok_or_else(|| {
            let message = "connect the output of a node 'integrate_scattering'";
            wrong_format(format!("the map holds {encoding}; {message}")).at_slot("integrated")
        })?;
        let capabilities = upstream.capabilities();
        let specialization = techniques::of_map(capabilities, &encoding)
            .constant(
                "OVERESTIMATION",
                format_args!("vec2f({towards:?}, {away:?})"),
            )
            .module(
                "scattering_ray",
                include_str!("../shared/scattering_ray.wgsl"),
            )
            .module("scattering_bounds", bounds);
        let (specialization, sampler) =
            moments_lookup(specialization, capabilities, &encoding, 1, 1);
        let specialization = specialization.module(
            "scattering_lookup",
            if sampler.is_some() {
                include_str!("lookup_sampled.wgsl")
            } else {
                include_str!("lookup_loaded.wgsl")
            },
        );
        let camera = upstream.texture("camera_depth")?;
        let wgsl = depth_input::of_camera(specialization, camera)
            .link(wgsl!("composite_scattering.wgsl"))?;
        let mut pass = Pass::fullscreen("composite", "scattering")
            .shader(wgsl, "composite")
            .bind("parameters", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"))
            .bind("moments_map", bind::layers("integrated"));
        pass.bindings.extend(sampler);
        let means = TextureRule::new(map_input::formats());
        let radiance = TextureRule::new(format).extent(Rule::same_as("camera_depth"));
        let description = "In-scattered radiance, and in alpha the transmittance to the surface.";
        Ok(NodeDesc::new("composite_scattering", Stage::AfterMainPass)
            .input(
                "integrated",
                "Means of the light's map along view rays.",
                means,
            )
            .input("camera_depth", "Where surfaces are.", depth_input::camera())
            .output("scattering", description, radiance)
            .pass(pass)
            .parameters(ParameterBlock::of::<CompositeScatteringParameters>(
                "CompositeScatteringParameters",
            ))
            // Nothing in the air: no light is added, and all of it comes through.
            .off("scattering", Off::Fill(vec![[0.0, 0.0, 0.0, 1.0]])))
    }
}
