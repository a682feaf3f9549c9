//! Turns a filtered map and the camera's depth into shadow intensity on the screen.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{LeakReduction, ReceiverBias, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::moments_input::moments_input;
use super::specialization::Specialization;
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource,
    Stage, Work,
};

mod parameters;

pub use parameters::{CameraView, LightDepth, LightView, SingularCamera};

const SHADER: &str = include_str!("shade_hard.wgsl");
const SAMPLED_LOOKUP: &str = include_str!("map_lookup_sampled.wgsl");
const LOADED_LOOKUP: &str = include_str!("map_lookup_loaded.wgsl");

/// Node `shade_hard`: `moments` (a filtered map) and `camera_depth` to `shadow_intensity`, of the camera's size. A
/// fullscreen pass: it can also be drawn into a render pass that the host has open. Parameters:
/// [`ShadeHardParameters`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ShadeHard {
    /// How moments become shadow intensity.
    #[serde(default)]
    pub technique: Technique,
    /// The format of the shadow intensity: r8unorm, r16float or r32float.
    #[serde(default = "default_format")]
    pub format: TextureFormat,
    /// Some samples multiply moments by a constant. Refused: the result bounds nothing.
    #[serde(default, skip_serializing)]
    pub moment_scale: Option<f32>,
}

fn default_format() -> TextureFormat {
    TextureFormat::R8Unorm
}

impl Default for ShadeHard {
    fn default() -> Self {
        Self {
            technique: Technique::default(),
            format: default_format(),
            moment_scale: None,
        }
    }
}

/// What a view's [`ShadeHard`] node needs to know: the uniform struct of its shader.
///
/// Made by [`ShadeHardParameters::new`] from a camera and a light.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ShadeHardParameters {
    /// From the camera's clip space to the light, by columns.
    pub light_from_camera: [[f32; 4]; 4],
    /// The homogeneous coordinate of the scene position.
    pub scene_w_from_camera: [f32; 4],
    /// How far fragments move towards the light.
    pub receiver_bias: ReceiverBias,
    /// What is done about light leaking after the bound.
    pub leak_reduction: LeakReduction,
    /// The stored depth of pixels that show no surface: 0 for reversed depth.
    pub far_depth: f32,
    /// The map's layer.
    pub layer: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: [f32; 2],
}

impl Node for ShadeHard {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        self.check()?;
        let (moments, storage) = moments_input(upstream)?;
        let capabilities = upstream.capabilities();
        let sampled = capabilities.support(moments.format).filterable;
        let lookup = if sampled {
            SAMPLED_LOOKUP
        } else {
            LOADED_LOOKUP
        };
        let wgsl = Specialization::new(capabilities)
            .constant("STORAGE", &format!("{}u", storage.wgsl_index()))
            .link("shade_hard.wgsl", SHADER, &[("map_lookup", lookup)])?;
        let mut bindings = vec![
            Binding {
                binding: 0,
                resource: BindingResource::Parameters,
            },
            Binding {
                binding: 1,
                resource: BindingResource::Layer("camera_depth".to_owned()),
            },
            Binding {
                binding: 2,
                resource: BindingResource::Layers("moments".to_owned()),
            },
        ];
        if sampled {
            bindings.push(Binding {
                binding: 3,
                resource: BindingResource::Sampler { filtering: true },
            });
        }
        let texture = |name: &str, direction, access, format, extent, layers| Slot {
            name: name.to_owned(),
            direction,
            lifetime: Lifetime::Frame,
            optional: false,
            resource: SlotResource::Texture {
                access,
                format,
                extent,
                layers,
                mips: CountRule::Exact(1),
                samples: CountRule::Exact(1),
            },
        };
        Ok(NodeDesc {
            name: "shade_hard".to_owned(),
            stage: Stage::AfterMainPass,
            slots: vec![
                texture(
                    "moments",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(
                        self.technique
                            .storages()
                            .iter()
                            .map(|storage| storage.format())
                            .collect(),
                    ),
                    ExtentRule::Any,
                    CountRule::Any,
                ),
                texture(
                    "camera_depth",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(vec![
                        TextureFormat::Depth32Float,
                        TextureFormat::Depth16Unorm,
                    ]),
                    ExtentRule::Any,
                    CountRule::Exact(1),
                ),
                texture(
                    "shadow_intensity",
                    Direction::Out,
                    Access::RENDER_TARGET,
                    FormatRule::Exact(self.format),
                    ExtentRule::SameAs("camera_depth".to_owned()),
                    CountRule::Exact(1),
                ),
            ],
            passes: vec![Pass {
                label: "shade".to_owned(),
                wgsl,
                entry_point: "shade".to_owned(),
                bindings,
                constants: [].into(),
                work: Work::Fullscreen {
                    target: "shadow_intensity".to_owned(),
                    each_layer: false,
                },
            }],
            parameters: Some(ParameterBlock {
                name: "ShadeHardParameters".to_owned(),
                size: size_of::<ShadeHardParameters>() as u32,
                each_layer_of: None,
                initial: Vec::new(),
            }),
        })
    }
}

impl ShadeHard {
    fn check(&self) -> Result<(), GraphError> {
        if self.moment_scale.is_some() {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                "'moment_scale' is refused: moments times a constant are the moments of no distribution, so that the result \
                 bounds nothing; use the leak reduction of the node's parameters instead",
            ));
        }
        let formats = [
            TextureFormat::R8Unorm,
            TextureFormat::R16Float,
            TextureFormat::R32Float,
        ];
        if !formats.contains(&self.format) {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                format!(
                    "shadow intensity is one number; 'format' is r8unorm, r16float or r32float, not {}",
                    self.format
                ),
            ));
        }
        Ok(())
    }
}
