//! Light that a medium scatters into each pixel's view ray.

use moment_shadows::{CompositeScatteringParameters, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::moments_input::{encoding_of, map_formats};
use super::moments_lookup::moments_lookup;
use super::specialization::{FULLSCREEN, Specialization};
use super::{drawn_map, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource,
    Stage, Work,
};

/// Node `composite_scattering`: `integrated` (from [`super::IntegrateScattering`]) and `camera_depth` to `scattering`, of the
/// camera's size: in-scattered radiance in red, green and blue, and in alpha the mean of the colours' transmittance between
/// camera and surface. Sky is at the far distance of the parameters. A fullscreen pass: it can also be drawn into a render
/// pass that the host has open, blended as source + source alpha x destination (`HostTarget::scattered`). Parameters:
/// [`CompositeScatteringParameters`].
///
/// One texel is looked up per pixel for four moments, two for six. Where the medium has no density the result is (0, 0, 0, 1) to
/// the bit, and so it is wherever a parameter is no finite number and the result would be none. Radiance is at most 65504.
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
        let integrated = upstream.texture("integrated")?;
        let encoding = encoding_of(integrated).map_err(|error| error.at_slot("integrated"))?;
        drawn_map::refuse_prefix_sums(&encoding, GraphErrorKind::Format)
            .map_err(|error| error.at_slot("integrated"))?;
        let bounds = match encoding.technique() {
            Technique::Hamburger4 => include_str!("scattering/bounds_four_moments.wgsl"),
            Technique::Hamburger6 => include_str!("scattering/bounds_six_moments.wgsl"),
            _ => {
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
            "composite_scattering.wgsl",
            include_str!("composite_scattering.wgsl"),
            &[
                FULLSCREEN,
                ("moments_lookup", lookup),
                ("scattering_bounds", bounds),
            ],
        )?;
        let mut bindings = vec![
            BindingResource::Parameters,
            BindingResource::Layer("camera_depth".to_owned()),
            BindingResource::Layers("integrated".to_owned()),
        ];
        bindings.extend(sampler);
        let depths = vec![TextureFormat::Depth32Float, TextureFormat::Depth16Unorm];
        Ok(NodeDesc {
            name: "composite_scattering".to_owned(),
            stage: Stage::AfterMainPass,
            slots: vec![
                slot(
                    "integrated",
                    Direction::In,
                    FormatRule::OneOf(map_formats()),
                ),
                slot("camera_depth", Direction::In, FormatRule::OneOf(depths)),
                slot("scattering", Direction::Out, FormatRule::Exact(format)),
            ],
            passes: vec![Pass {
                label: "composite".to_owned(),
                wgsl,
                entry_point: "composite".to_owned(),
                bindings: (0..)
                    .zip(bindings)
                    .map(|(binding, resource)| Binding { binding, resource })
                    .collect(),
                constants: [].into(),
                plane: 0,
                work: Work::Fullscreen {
                    target: "scattering".to_owned(),
                    each_layer: false,
                },
            }],
            parameters: Some(ParameterBlock {
                name: "CompositeScatteringParameters".to_owned(),
                size: size_of::<CompositeScatteringParameters>() as u32,
                elements: 1,
                each_layer_of: None,
                initial: Vec::new(),
            }),
        })
    }
}

fn slot(name: &str, direction: Direction, format: FormatRule) -> Slot {
    let (access, extent) = match direction {
        Direction::In => (Access::READ, ExtentRule::Any),
        _ => (
            Access::RENDER_TARGET,
            ExtentRule::SameAs("camera_depth".to_owned()),
        ),
    };
    Slot {
        name: name.to_owned(),
        direction,
        lifetime: Lifetime::Frame,
        optional: false,
        resource: SlotResource::Texture {
            access,
            format,
            extent,
            layers: CountRule::Exact(1),
            mips: CountRule::Exact(1),
            samples: CountRule::Exact(1),
        },
    }
}
