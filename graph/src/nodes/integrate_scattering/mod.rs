//! Prefix sums of a rectified map: the part of every view ray that is shadowed.

use moment_shadows::{IntegrateScatteringParameters, TextureFormat};
use serde::Deserialize;

use super::shared::{map_input, regions, wgsl, wrong_format};
use super::techniques;
use crate::{
    Connected, GraphError, Node, NodeDesc, ParameterBlock, Pass, Rule, Slot, Stage, TextureRule,
    bind,
};

/// Node `integrate_scattering`: `rectified` (from [`super::RectifyMoments`]) to `integrated`, of the same size, encoding and
/// storage: each texel is the mean of the texels of its row up to itself, weighted with the transmittance of the medium
/// between camera and texel. Parameters: [`IntegrateScatteringParameters`].
///
/// With the optional input `view_rays` (from the same node) the weights of each texel are those of the view rays that end there, rather
/// than one for all view rays of its row.
///
/// Sums are f32 and rounded once. On a GPU a workgroup sums up a row, on a software adapter an invocation does. Which
/// transmittance serves all view rays of a row, and what that costs, is said in the WGSL module `scattering_weights`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct IntegrateScattering {}

impl Node for IntegrateScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (rectified, encoding) = map_input::connected_rectified(upstream, "rectified")?;
        regions::refuse_prefix_sums(&encoding)
            .map_err(|message| wrong_format(message).at_slot("rectified"))?;
        let capabilities = upstream.capabilities();
        let (shader, rows) = if capabilities.software_adapter {
            (wgsl!("integrate_scattering_serial.wgsl"), 64)
        } else {
            (wgsl!("integrate_scattering_parallel.wgsl"), 1)
        };
        let target = include_str!("integrate_scattering_target.wgsl");
        let seen = upstream.get("view_rays").is_some();
        let sums = if seen {
            include_str!("row_sums_seen.wgsl")
        } else {
            include_str!("row_sums_all.wgsl")
        };
        let wgsl = techniques::of_map(capabilities, &encoding)
            .module("integrate_target", target)
            .module("row_sums", sums)
            .link(shader)?;
        let mut pass = Pass::compute("integrate", "integrated", [regions::ENDLESS, rows])
            .shader(wgsl, "integrate")
            .bind("parameters", bind::parameters())
            .bind("rectified_map", bind::layer("rectified"))
            .bind("integrated_map", bind::store("integrated"));
        if seen {
            pass = pass.bind("view_rays_map", bind::layer("view_rays"));
        }
        let rule = TextureRule::new(map_input::formats());
        let means = TextureRule::new(Rule::same_as("rectified")).extent(Rule::same_as("rectified"));
        let description = "Its weighted means from the camera to each texel.";
        let block =
            ParameterBlock::of::<IntegrateScatteringParameters>("IntegrateScatteringParameters");
        let rays = Slot::input(
            "view_rays",
            "Which view rays end in each texel of that.",
            TextureRule::new(TextureFormat::Rg32Uint).extent(rectified.size),
        );
        let stage = match seen {
            false => Stage::AfterShadowMaps,
            true => Stage::AfterMainPass,
        };
        Ok(NodeDesc::new("integrate_scattering", stage)
            .input(
                "rectified",
                "The light's map by distance and azimuth.",
                rule,
            )
            .slots([rays.optional()])
            .output("integrated", description, means)
            .passes(regions::of_each_plane(rectified.planes, vec![pass]))
            .parameters(block))
    }
}
