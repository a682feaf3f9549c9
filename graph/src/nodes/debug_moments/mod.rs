//! Shows a map of moments as a picture.

use moment_shadows::{Storage, TextureFormat};
use serde::{Deserialize, Serialize};

use super::shared::{Specialization, map_input, wgsl, wrong_property};
use crate::{Connected, GraphError, Node, NodeDesc, Off, Pass, Stage, TextureRule, bind};

/// What [`DebugMoments`] shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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

/// Node `debug_moments`: `map` to `picture`, rgba8unorm, of the map's size and layers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct DebugMoments {
    /// What is shown.
    pub show: Show,
    /// The mip level, magnified to the size of the map.
    pub level: u32,
}

impl Node for DebugMoments {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, encoding) = map_input::of_four_moments(upstream, "shows")?;
        map_input::refuse_blended(&encoding)?;
        map_input::refuse_packed(&encoding)?;
        if self.level >= map.mips {
            return Err(wrong_property(format!(
                "'level' is {}, but the map has {} mip levels, counted from 0",
                self.level, map.mips
            )));
        }
        let wgsl = Specialization::new(upstream.capabilities())
            .unsigned("STORAGE", encoding.storage().wgsl_index())
            .constant("ROUNDED_INWARDS", encoding.is_rounded_inwards())
            .unsigned("SHOW", self.show as u32)
            .link(wgsl!("debug_moments.wgsl"))?;
        let pass = Pass::fullscreen("debug", "picture")
            .each_layer()
            .shader(wgsl, "debug")
            .bind("moments_level", bind::level("map", self.level));
        let rule = map_input::rule(Storage::OF_FOUR_MOMENTS.map(Storage::format).to_vec());
        let picture = TextureRule::new(TextureFormat::Rgba8Unorm).like("map");
        Ok(NodeDesc::new("debug_moments", Stage::AfterShadowMaps)
            .input("map", "The map to show.", rule)
            .output("picture", "A colour per texel of the map.", picture)
            .pass(pass)
            .off("picture", Off::Fill(vec![[0.0; 4]])))
    }
}
