//! Prefix sums of a rectified map: the part of every view ray that is shadowed.

use moment_shadows::IntegrateScatteringParameters;
use serde::{Deserialize, Serialize};

use super::shared::{NoProperties, Specialization, map_input, regions, wgsl};
use super::techniques;
use crate::{
    Connected, GraphError, GraphErrorKind, Node, NodeDesc, ParameterBlock, Pass, Rule, Stage,
    TextureRule, bind,
};

/// Node `integrate_scattering`: `rectified` (from [`super::RectifyMoments`]) to `integrated`, of the same size, encoding and
/// storage: each texel is the mean of the texels of its row up to itself, weighted with the transmittance of the medium
/// between camera and texel. Means need no more range than what they are made of, whatever the storage. Parameters:
/// [`IntegrateScatteringParameters`].
///
/// Sums are f32 and rounded once. On a GPU a workgroup sums up a row, on a software adapter an invocation does. Which
/// transmittance serves all view rays of a row, and what that costs, is said in the WGSL module `scattering_weights`. The medium
/// is homogeneous: otherwise sums along rows would be of another medium for each view ray.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "NoProperties", into = "NoProperties")]
pub struct IntegrateScattering;

/// Texels that a row may have: more than any texture.
const ENDLESS: u32 = 65536;

impl Node for IntegrateScattering {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (rectified, encoding) = map_input::connected(upstream, "rectified")?;
        regions::refuse_prefix_sums(&encoding, GraphErrorKind::Format)
            .map_err(|error| error.at_slot("rectified"))?;
        let capabilities = upstream.capabilities();
        let (shader, rows) = if capabilities.software_adapter {
            (wgsl!("integrate_scattering_serial.wgsl"), 64)
        } else {
            (wgsl!("integrate_scattering_parallel.wgsl"), 1)
        };
        let target = include_str!("integrate_scattering_target.wgsl");
        let wgsl = techniques::specialize_map(Specialization::new(capabilities), &encoding)
            .link(shader, &[("integrate_target", target)])?;
        let passes = (0..rectified.planes).map(|plane| {
            let label = match rectified.planes {
                1 => "integrate".to_owned(),
                _ => format!("integrate plane {plane}"),
            };
            Pass::compute(label, "integrated", [ENDLESS, rows])
                .shader(wgsl.as_str(), "integrate")
                .bind("parameters", bind::parameters())
                .bind("rectified_map", bind::layer("rectified"))
                .bind("integrated_map", bind::store("integrated"))
                .plane(plane)
        });
        Ok(
            NodeDesc::new("integrate_scattering", Stage::AfterShadowMaps)
                .input(
                    "rectified",
                    "The light's map by distance and azimuth.",
                    TextureRule::new(map_input::FORMATS.as_slice()),
                )
                .output(
                    "integrated",
                    "Its weighted means from the camera to each texel.",
                    TextureRule::new(Rule::same_as("rectified")).extent(Rule::same_as("rectified")),
                )
                .passes(passes)
                .parameters(ParameterBlock::of::<IntegrateScatteringParameters>(
                    "IntegrateScatteringParameters",
                )),
        )
    }
}
