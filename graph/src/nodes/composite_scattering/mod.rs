//! Light that a medium scatters into each pixel's view ray.

use moment_shadows::{CompositeScatteringParameters, TextureFormat};
use serde::{Deserialize, Serialize};

use super::shared::lookup::moments_lookup;
use super::shared::{self, FULLSCREEN, Specialization, map_input, regions, wgsl};
use super::techniques::{self, Bounded};
use crate::{
    Connected, GraphError, GraphErrorKind, Node, NodeDesc, ParameterBlock, Pass, Rule, Stage,
    TextureRule, bind,
};

/// Node `composite_scattering`: `integrated` (from [`super::IntegrateScattering`]) and `camera_depth` to `scattering`, of the
/// camera's size: in-scattered radiance in red, green and blue, and in alpha the mean of the colours' transmittance between
/// camera and surface. Sky is at the far distance of the parameters. A fullscreen pass: it can also be drawn into a render
/// pass that the host has open, blended as source + source alpha x destination (`HostTarget::scattered`). Parameters:
/// [`CompositeScatteringParameters`].
///
/// One texel is looked up per pixel for four moments, two for six. A medium without density, or with parameters that would give
/// a non-finite result, gives exactly (0, 0, 0, 1). Radiance is at most 65504.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CompositeScattering {
    /// The format of the radiance: rgba16float or rgba32float. Where it is left out, rgba16float.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub format: Option<TextureFormat>,
    /// How strongly the shown shadow leans from the middle of its bounds towards one of them.
    #[serde(default)]
    pub overestimation: Overestimation,
}

/// Adaptive overestimation (Peters, GDC 2016; Peters et al., JCGT 6(1) 2017, section 7): looking towards the light the shadow leans
/// to its upper bound, whose error is darkness, looking away from it to the lower one, whose light leaks into shadow, both in
/// proportion to the cosine of the angle between view ray and light, and each as strongly as is given: from 0, the middle of the
/// bounds, to 1, all the way. The default is near the smallest error of every scene and view that was measured; the published
/// form, [`Overestimation::PUBLISHED`], has a larger one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Overestimation {
    /// Looking towards the light.
    pub towards: f32,
    /// Looking away from it.
    pub away: f32,
}

impl Overestimation {
    /// All the way.
    pub const PUBLISHED: Overestimation = Overestimation {
        towards: 1.0,
        away: 1.0,
    };
}

impl Default for Overestimation {
    fn default() -> Self {
        Self {
            towards: 0.2,
            away: 0.35,
        }
    }
}

impl Node for CompositeScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let format = self.format.unwrap_or(TextureFormat::Rgba16Float);
        if !matches!(
            format,
            TextureFormat::Rgba16Float | TextureFormat::Rgba32Float
        ) {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                format!(
                    "radiance has no upper limit; 'format' is rgba16float or rgba32float, not {format}"
                ),
            ));
        }
        let Overestimation { towards, away } = self.overestimation;
        for (name, strength) in [("towards", towards), ("away", away)] {
            if !(0.0..=1.0).contains(&strength) {
                return Err(GraphError::new(
                    GraphErrorKind::Property,
                    format!(
                        "'{name}' of 'overestimation' is {strength}; it is from 0 (the middle of the bounds) to 1 (all the way to \
                         one of them)"
                    ),
                ));
            }
        }
        let (integrated, encoding) = map_input::connected(upstream, "integrated")?;
        regions::refuse_prefix_sums(&encoding, GraphErrorKind::Format)
            .map_err(|error| error.at_slot("integrated"))?;
        let bounds = match techniques::both_bounds(encoding.technique()) {
            Some(Bounded::Four) => include_str!("bounds_four_moments.wgsl"),
            Some(Bounded::Six) => include_str!("bounds_six_moments.wgsl"),
            None => {
                return Err(GraphError::new(
                    GraphErrorKind::Format,
                    format!(
                        "the map holds {encoding}; connect the output of a node 'integrate_scattering'"
                    ),
                )
                .at_slot("integrated"));
            }
        };
        let capabilities = upstream.capabilities();
        let (lookup, sampler) = moments_lookup(integrated.format, 1, 1, true, capabilities);
        let specialization = Specialization::new(capabilities)
            .constant("LEVELS", "1u")
            .constant("ANISOTROPY", "1.0")
            .constant("OVERESTIMATION", &format!("vec2f({towards:?}, {away:?})"));
        let wgsl = techniques::specialize_map(specialization, &encoding).link(
            wgsl!("composite_scattering.wgsl"),
            &[FULLSCREEN, lookup, ("scattering_bounds", bounds)],
        )?;
        let mut pass = Pass::fullscreen("composite", "scattering")
            .shader(wgsl, "composite")
            .bind("parameters", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"))
            .bind("moments_map", bind::layers("integrated"));
        pass.bindings.extend(sampler);
        Ok(NodeDesc::new("composite_scattering", Stage::AfterMainPass)
            .input(
                "integrated",
                "Means of the light's map along view rays.",
                TextureRule::new(map_input::FORMATS.as_slice()),
            )
            .input("camera_depth", "Where surfaces are.", shared::depth())
            .output(
                "scattering",
                "In-scattered radiance, and in alpha the transmittance to the surface.",
                TextureRule::new(format).extent(Rule::same_as("camera_depth")),
            )
            .pass(pass)
            .parameters(ParameterBlock::of::<CompositeScatteringParameters>(
                "CompositeScatteringParameters",
            )))
    }
}
