//! Prefix sums of a rectified map: the part of every view ray that is shadowed.

use serde::{Deserialize, Serialize};

use super::moments_input::{encoding_of, map_formats};
use super::specialization::Specialization;
use super::{drawn_map, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource,
    Stage, Work,
};
use moment_shadows::IntegrateScatteringParameters;

/// Node `integrate_scattering`: `rectified` (from [`super::RectifyMoments`]) to `integrated`, of the same size, encoding and
/// storage: each texel is the mean of the texels of its row up to itself, weighted with the transmittance of the medium
/// between camera and texel. Means need no more range than what they are made of, whatever the storage. Parameters:
/// [`IntegrateScatteringParameters`].
///
/// Sums are f32 and rounded once. On a GPU a workgroup sums up a row, on a software adapter an invocation does. Which
/// transmittance serves all view rays of a row, and what that costs, is said in the WGSL module `scattering_weights`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IntegrateScattering {
    /// The kind of medium that the sums are for.
    #[serde(default)]
    pub medium: Medium,
}

/// Kinds of media.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Medium {
    /// The same extinction and scattering everywhere.
    #[default]
    Homogeneous,
    /// Density that differs from place to place. Refused: sums along rows would be of another medium for each view ray.
    Inhomogeneous,
}

/// Texels that a row may have: more than any texture.
const ENDLESS: u32 = 65536;

impl Node for IntegrateScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        if self.medium != Medium::Homogeneous {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                "'medium' is 'inhomogeneous'; all view rays of a row share its sums, which they can in a homogeneous medium \
                 alone: give it one density, or march its scattering",
            ));
        }
        let rectified = upstream.texture("rectified")?;
        let encoding = encoding_of(rectified).map_err(|error| error.at_slot("rectified"))?;
        drawn_map::refuse_prefix_sums(&encoding, GraphErrorKind::Format)
            .map_err(|error| error.at_slot("rectified"))?;
        let capabilities = upstream.capabilities();
        let (file, shader, rows) = if capabilities.software_adapter {
            let text = include_str!("integrate_scattering_serial.wgsl");
            ("integrate_scattering_serial.wgsl", text, 64)
        } else {
            let text = include_str!("integrate_scattering_parallel.wgsl");
            ("integrate_scattering_parallel.wgsl", text, 1)
        };
        let wgsl = techniques::specialize_map(Specialization::new(capabilities), &encoding).link(
            file,
            shader,
            &[
                (
                    "integrate_target",
                    include_str!("integrate_scattering_target.wgsl"),
                ),
                techniques::filtering(encoding.technique()),
            ],
        )?;
        let bindings: Vec<Binding> = (0..)
            .zip([
                BindingResource::Parameters,
                BindingResource::Layer("rectified".to_owned()),
                BindingResource::StorageLayer("integrated".to_owned()),
            ])
            .map(|(binding, resource)| Binding { binding, resource })
            .collect();
        let passes = (0..rectified.planes)
            .map(|plane| Pass {
                label: match rectified.planes {
                    1 => "integrate".to_owned(),
                    _ => format!("integrate plane {plane}"),
                },
                wgsl: wgsl.clone(),
                entry_point: "integrate".to_owned(),
                bindings: bindings.clone(),
                constants: [].into(),
                plane,
                work: Work::Compute {
                    covers: "integrated".to_owned(),
                    texels_per_workgroup: [ENDLESS, rows],
                    each_layer: false,
                },
            })
            .collect();
        Ok(NodeDesc {
            name: "integrate_scattering".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: vec![
                slot(
                    "rectified",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(map_formats()),
                    ExtentRule::Any,
                ),
                slot(
                    "integrated",
                    Direction::Out,
                    Access::STORAGE_WRITE,
                    FormatRule::SameAs("rectified".to_owned()),
                    ExtentRule::SameAs("rectified".to_owned()),
                ),
            ],
            passes,
            parameters: Some(ParameterBlock {
                name: "IntegrateScatteringParameters".to_owned(),
                size: size_of::<IntegrateScatteringParameters>() as u32,
                elements: 1,
                each_layer_of: None,
                initial: Vec::new(),
            }),
        })
    }
}

fn slot(
    name: &str,
    direction: Direction,
    access: Access,
    format: FormatRule,
    extent: ExtentRule,
) -> Slot {
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
