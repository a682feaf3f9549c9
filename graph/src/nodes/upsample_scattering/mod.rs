//! Scattered light at the full resolution, from a part of it.

use moment_shadows::TextureFormat::{Rgba16Float, Rgba32Float};
use moment_shadows::{Resolution, UpsampleScatteringParameters};
use serde::Deserialize;

use super::shared::{Specialization, depth_input, wgsl, wrong_size};
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, Rule, Stage, TextureRule,
    bind,
};

/// Node `upsample_scattering`: `scattering` (from [`super::MarchScattering`] at half or a quarter of the resolution) and
/// `camera_depth` to `upsampled`, of the camera's size: of the four nearest texels around a pixel those count that saw what lies
/// as far away. At full resolution, which the steps `"best"` may have, every texel is that of its pixel. A fullscreen pass: it can also be drawn into a render pass that the host has open, blended as
/// `composite_scattering` is. Parameters: [`UpsampleScatteringParameters`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct UpsampleScattering {}

impl Node for UpsampleScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let camera = upstream.texture("camera_depth")?;
        let scattering = upstream.texture("scattering")?;
        // Where several fit, there is one texel, and nothing between texels.
        let parts = [Resolution::Full, Resolution::Half, Resolution::Quarter];
        let parts = parts.map(Resolution::pixels_per_texel);
        let fits = |per: &u32| camera.size.map(|side| side.div_ceil(*per)) == scattering.size;
        let per_texel = parts.into_iter().find(fits).ok_or_else(|| {
            let ([x, y], [width, height]) = (scattering.size, camera.size);
            wrong_size(format!(
                "it has {x}x{y} texels, which is neither {width}x{height} nor half or a quarter of that, rounded up; connect a \
                 node 'march_scattering' that sees the same 'camera_depth'"
            ))
            .at_slot("scattering")
        })?;
        let specialization =
            Specialization::new(upstream.capabilities()).unsigned("PER_TEXEL", per_texel);
        let wgsl = depth_input::of_camera(specialization, camera)
            .link(wgsl!("upsample_scattering.wgsl"))?;
        let pass = Pass::fullscreen("upsample", "upsampled")
            .shader(wgsl, "upsample")
            .bind("parameters", bind::parameters())
            .bind("camera_depth", bind::layer("camera_depth"))
            .bind("scattering", bind::layer("scattering"));
        let radiance = TextureRule::new(vec![Rgba16Float, Rgba32Float]);
        let upsampled =
            TextureRule::new(Rule::same_as("scattering")).extent(Rule::same_as("camera_depth"));
        let description = "Radiance and transmittance of every pixel.";
        Ok(NodeDesc::new("upsample_scattering", Stage::AfterMainPass)
            .input(
                "scattering",
                "Radiance and transmittance of every so many pixels.",
                radiance,
            )
            .input("camera_depth", "Where surfaces are.", depth_input::camera())
            .output("upsampled", description, upsampled)
            .pass(pass)
            .parameters(ParameterBlock::of::<UpsampleScatteringParameters>(
                "UpsampleScatteringParameters",
            ))
            .off("upsampled", Off::Fill(vec![[0.0, 0.0, 0.0, 1.0]])))
    }
}
