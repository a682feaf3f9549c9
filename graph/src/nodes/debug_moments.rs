//! Shows a map of moments as a picture.

use moment_shadows::{Storage, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::moments_input::moments_input;
use super::specialization::{FULLSCREEN, Specialization};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, MipLevel, Node, NodeDesc, Pass, Slot, SlotResource,
    Stage, Work,
};

const SHADER: &str = include_str!("debug_moments.wgsl");

/// What [`DebugMoments`] shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Show {
    /// The first three moments as red, green and blue; odd ones from -1 to 1, black to full.
    Moments,
    /// The mean depth: black at the light's near end, white at the far end.
    #[default]
    Mean,
    /// The standard deviation of depth: white is 1, the most there can be.
    Deviation,
    /// Whether any distribution has these moments: green if so; yellow if it takes the storage's moment bias, as rounding
    /// commonly does; red if even that does not help; magenta where a channel is infinite or NaN; blue where there is
    /// nothing but the far end.
    Validity,
}

/// Node `debug_moments`: `moments` to `picture`, rgba8unorm, of the map's size and layers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DebugMoments {
    /// What is shown.
    #[serde(default)]
    pub show: Show,
    /// The mip level, magnified to the size of the map.
    #[serde(default)]
    pub level: u32,
}

impl Node for DebugMoments {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (moments, encoding) = moments_input(upstream)?;
        if !encoding.technique().shares_map_with(&Technique::Hamburger4) {
            return Err(GraphError::new(
                GraphErrorKind::Format,
                format!(
                    "the map holds {encoding}; this node shows four moments: give the node that makes the map the technique \
                     'hamburger4'"
                ),
            )
            .at_slot("map"));
        }
        if self.level >= moments.mips {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                format!(
                    "'level' is {}, but the map has {} mip levels, counted from 0",
                    self.level, moments.mips
                ),
            ));
        }
        let wgsl = Specialization::new(upstream.capabilities())
            .constant("STORAGE", &format!("{}u", encoding.storage().wgsl_index()))
            .constant("SHOW", &format!("{}u", self.show as u32))
            .link("debug_moments.wgsl", SHADER, &[FULLSCREEN])?;
        let texture = |name: &str, direction, access, format, extent, layers, mips| Slot {
            name: name.to_owned(),
            direction,
            lifetime: Lifetime::Frame,
            optional: false,
            resource: SlotResource::Texture {
                access,
                format,
                extent,
                layers,
                mips,
                samples: CountRule::Exact(1),
            },
        };
        Ok(NodeDesc {
            name: "debug_moments".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: vec![
                texture(
                    "map",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(Storage::OF_FOUR_MOMENTS.map(Storage::format).to_vec()),
                    ExtentRule::Any,
                    CountRule::Any,
                    CountRule::Any,
                ),
                texture(
                    "picture",
                    Direction::Out,
                    Access::RENDER_TARGET,
                    FormatRule::Exact(TextureFormat::Rgba8Unorm),
                    ExtentRule::SameAs("map".to_owned()),
                    CountRule::SameAs("map".to_owned()),
                    CountRule::Exact(1),
                ),
            ],
            passes: vec![Pass {
                label: "debug".to_owned(),
                wgsl,
                entry_point: "debug".to_owned(),
                bindings: vec![Binding {
                    binding: 0,
                    resource: BindingResource::Level(MipLevel {
                        slot: "map".to_owned(),
                        level: self.level,
                    }),
                }],
                constants: [].into(),
                plane: 0,
                work: Work::Fullscreen {
                    target: "picture".to_owned(),
                    each_layer: true,
                },
            }],
            parameters: None,
        })
    }
}
