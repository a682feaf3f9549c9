//! Resamples a light's map in the rectified coordinates of a camera.

use moment_shadows::{MapEncoding, RectifyMomentsParameters, Storage, Technique};
use serde::{Deserialize, Serialize};

use super::shared::lookup::moments_lookup;
use super::shared::{Specialization, map_input, regions, wgsl};
use super::techniques::{self, Bounded};
use crate::{
    Connected, GraphError, GraphErrorKind, Node, NodeDesc, ParameterBlock, Pass, Stage,
    TextureRule, bind,
};

/// Node `rectify_moments`: `map` (four moments, filtered, of any storage) to `rectified`, a map whose columns are distances
/// from the light ray through the camera and whose rows are azimuths about it, as the WGSL module `rectified_frame`
/// describes. A first step to single scattering; [`super::IntegrateScattering`] is the second. Parameters:
/// [`RectifyMomentsParameters`].
///
/// Each texel is one light ray, looked up in the light's map over the texel's own footprint where that has mip levels; rays
/// outside of the map are lit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RectifyMoments {
    /// `hamburger4` or `hamburger6`: how many moments the two depths of a texel are encoded as again.
    #[serde(default)]
    pub technique: Technique,
    /// How they are stored: not as `unorm10`, since prefix sums are written by compute shaders.
    pub storage: Storage,
    /// Columns and rows, each from 2 to 8192.
    #[serde(default = "default_extent")]
    pub extent: [u32; 2],
}

fn default_extent() -> [u32; 2] {
    [512, 512]
}

/// Probes of a lookup in a map with mip levels.
const ANISOTROPY: u16 = 8;

impl Node for RectifyMoments {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, source) = map_input::of_four_moments(upstream, "resamples")?;
        let (encoding, texel) = self.encoding()?;
        let capabilities = upstream.capabilities();
        let (lookup, sampler) =
            moments_lookup(map.format, map.mips, ANISOTROPY, true, capabilities);
        let specialization = Specialization::new(capabilities)
            .unsigned("SOURCE_STORAGE", source.storage().wgsl_index())
            .unsigned("LEVELS", map.mips)
            .constant("ANISOTROPY", &format!("{ANISOTROPY}.0"));
        let wgsl = techniques::specialize_map(specialization, &encoding).link(
            wgsl!("rectify_moments.wgsl"),
            &[("rectified_texel", texel), lookup],
        )?;
        let passes = (0..encoding.planes()).map(|plane| {
            let named = techniques::encodes_planes(&self.technique);
            let label = if named {
                format!("rectify plane {plane}")
            } else {
                "rectify".to_owned()
            };
            let mut pass = Pass::compute(label, "rectified", [8, 8])
                .shader(wgsl.as_str(), "rectify")
                .bind("parameters", bind::parameters())
                .bind("rectified_map", bind::store("rectified"))
                .bind("moments_map", bind::layers("map"))
                .plane(plane);
            pass.bindings.extend(sampler.clone());
            if named {
                pass = pass.constant("PLANE", plane);
            }
            pass
        });
        Ok(NodeDesc::new("rectify_moments", Stage::AfterShadowMaps)
            .input(
                "map",
                "The light's filtered map of four moments.",
                map_input::rule(&map_input::FORMATS),
            )
            .output(
                "rectified",
                "The map by distance from the light ray through the camera, and by azimuth about it.",
                TextureRule::of_map(encoding.clone()).extent(self.extent),
            )
            .passes(passes)
            .parameters(ParameterBlock::of::<RectifyMomentsParameters>(
                "RectifyMomentsParameters",
            )))
    }
}

impl RectifyMoments {
    /// How the two depths of a texel are encoded, and the text that does it.
    fn encoding(&self) -> Result<(MapEncoding, &'static str), GraphError> {
        let property = |message: String| GraphError::new(GraphErrorKind::Property, message);
        let texel = match techniques::both_bounds(&self.technique) {
            Some(Bounded::Four) => include_str!("rectified_four_moments.wgsl"),
            Some(Bounded::Six) => include_str!("rectified_six_moments.wgsl"),
            None => {
                return Err(property(format!(
                    "'technique' is '{}'; single scattering has both bounds of 'hamburger4' and 'hamburger6' alone",
                    self.technique
                )));
            }
        };
        if self.extent.iter().any(|side| !(2..=8192).contains(side)) {
            return Err(property(format!(
                "'extent' is {}x{}; columns and rows are 2 to 8192 each",
                self.extent[0], self.extent[1]
            )));
        }
        let encoding =
            MapEncoding::new(self.technique.clone(), self.storage).map_err(techniques::property)?;
        regions::refuse_prefix_sums(&encoding, GraphErrorKind::Property)?;
        Ok((encoding, texel))
    }
}
