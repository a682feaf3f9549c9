//! Resamples a light's map in the rectified coordinates of a camera.

use moment_shadows::{MapEncoding, RectifyMomentsParameters, Storage, Technique};
use serde::Deserialize;

use super::shared::lookup::moments_lookup;
use super::shared::{map_input, range_input, regions, wgsl, wrong_property};
use super::techniques;
use crate::{
    Connected, GraphError, Node, NodeDesc, ParameterBlock, Pass, Stage, TextureRule, bind,
};

/// Node `rectify_moments`: `map` (four moments, filtered, of any storage) to `rectified`, a map whose columns are distances
/// from the light ray through the camera and whose rows are azimuths about it (WGSL module `rectified_frame`), for
/// [`super::IntegrateScattering`]. Parameters: [`RectifyMomentsParameters`].
///
/// Each texel is one light ray, looked up over the texel's own footprint where the map has mip levels; rays outside are lit.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
        map_input::refuse_blended(&source)?;
        map_input::refuse_packed(&source)?;
        range_input::refuse(map, "resamples depths")?;
        let technique = &self.technique;
        let texel = techniques::of_both_bounds(
            technique,
            include_str!("rectified_four_moments.wgsl"),
            include_str!("rectified_six_moments.wgsl"),
        )
        .ok_or_else(|| {
            wrong_property(format!(
                "'technique' is '{technique}'; single scattering has both bounds of 'hamburger4' and 'hamburger6' alone"
            ))
        })?;
        let [columns, rows] = self.extent;
        if !(2..=8192).contains(&columns) || !(2..=8192).contains(&rows) {
            return Err(wrong_property(format!(
                "'extent' is {columns}x{rows}; columns and rows are 2 to 8192 each"
            )));
        }
        let encoding = MapEncoding::new(technique.clone(), self.storage).map_err(wrong_property)?;
        regions::refuse_prefix_sums(&encoding).map_err(wrong_property)?;
        let capabilities = upstream.capabilities();
        let specialization = techniques::of_map(capabilities, &encoding)
            .unsigned("SOURCE_STORAGE", source.storage().wgsl_index())
            .module("rectified_texel", texel);
        let (specialization, sampler) =
            moments_lookup(specialization, capabilities, &source, map.mips, ANISOTROPY);
        let wgsl = specialization.link(wgsl!("rectify_moments.wgsl"))?;
        let mut pass = Pass::compute("rectify", "rectified", [8, 8])
            .shader(wgsl, "rectify")
            .bind("parameters", bind::parameters())
            .bind("rectified_map", bind::store("rectified"))
            .bind("moments_map", bind::layers("map"));
        if encoding.planes() > 1 {
            pass = pass.bind("rectified_even", bind::store_plane("rectified", 1));
        }
        pass.bindings.extend(sampler);
        let rule = map_input::rule(map_input::formats());
        let rectified = TextureRule::of_map(encoding.clone()).extent(self.extent);
        let description =
            "The map by distance from the light ray through the camera, and by azimuth about it.";
        let block = ParameterBlock::of::<RectifyMomentsParameters>("RectifyMomentsParameters");
        Ok(NodeDesc::new("rectify_moments", Stage::AfterShadowMaps)
            .input("map", "The light's filtered map of four moments.", rule)
            .output("rectified", description, rectified)
            .pass(pass)
            .parameters(block)
            .off("rectified", techniques::no_shadow(&encoding)))
    }
}
