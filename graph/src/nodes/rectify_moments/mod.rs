//! Resamples a light's map in the rectified coordinates of a camera.

use moment_shadows::{MapEncoding, RectifyMomentsParameters, Storage, Technique, TextureFormat};
use serde::Deserialize;

use super::shared::lookup::moments_lookup;
use super::shared::{
    Specialization, depth_input, map_input, range_input, regions, wgsl, wrong_property,
};
use super::techniques;
use crate::{
    Access, Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, ResourceDesc, Slot,
    SlotResource, Stage, TextureDesc, TextureRule, bind,
};

/// Node `rectify_moments`: `map` (four moments, filtered, of any storage) to `rectified`, a map whose columns are distances
/// from the light ray through the camera and whose rows are azimuths about it (WGSL module `rectified_frame`), for
/// [`super::IntegrateScattering`]. Parameters: [`RectifyMomentsParameters`].
///
/// Each texel is one light ray, looked up over the texel's own footprint where the map has mip levels; rays outside are lit.
///
/// With the optional input `camera_depth`, occluders that shadow every view ray that passes their texel, or none, count as such (WGSL
/// module `view_rays`): the bounds of shadow become sharper, and lit surfaces no longer darken the air before them. The node
/// then has an output `view_rays` of the same extent, which [`super::IntegrateScattering`] takes, and is recorded after the main pass.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RectifyMoments {
    /// `hamburger4` or `hamburger6`: how many moments the two depths of a texel are encoded as again.
    #[serde(default)]
    pub technique: Technique,
    /// How they are stored: not as `unorm10`, since prefix sums are written by compute shaders. Six moments can be `unorm8`: half of the
    /// memory of float16, at a greater error.
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
        let encoding =
            MapEncoding::rectified(technique.clone(), self.storage).map_err(wrong_property)?;
        regions::refuse_prefix_sums(&encoding).map_err(wrong_property)?;
        let camera = upstream.get("camera_depth").and_then(ResourceDesc::texture);
        let seen = camera.map(|camera| self.view_rays(camera, upstream));
        let seen = seen.transpose()?;
        let occluders = match seen {
            None => include_str!("occluders_all.wgsl"),
            Some(_) => include_str!("occluders_seen.wgsl"),
        };
        let capabilities = upstream.capabilities();
        let specialization = techniques::of_map(capabilities, &encoding)
            .unsigned("SOURCE_STORAGE", source.storage().wgsl_index())
            .module("rectify_parameters", PARAMETERS)
            .module("occluders_shares", include_str!("occluders_shares.wgsl"))
            .module("occluders", occluders)
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
        if seen.is_some() {
            pass = pass.bind("view_rays_map", bind::layer("view_rays"));
        }
        let rule = map_input::rule(map_input::formats());
        let rectified = TextureRule::of_map(encoding.clone()).extent(self.extent);
        let description =
            "The map by distance from the light ray through the camera, and by azimuth about it.";
        let block = ParameterBlock::of::<RectifyMomentsParameters>("RectifyMomentsParameters");
        let stage = match seen {
            None => Stage::AfterShadowMaps,
            Some(_) => Stage::AfterMainPass,
        };
        let camera = Slot::input(
            "camera_depth",
            "Where view rays end.",
            depth_input::camera(),
        );
        let mut desc = NodeDesc::new("rectify_moments", stage)
            .input("map", "The light's filtered map of four moments.", rule)
            .slots([camera.optional()])
            .output("rectified", description, rectified)
            .off("rectified", techniques::no_shadow(&encoding));
        if let Some((slots, passes)) = seen {
            // Nothing is known of view rays.
            let all = Off::Fill(vec![[f64::from(0xffff_0000_u32), 0.0, 0.0, 0.0]]);
            desc = desc.slots(slots).passes(passes).off("view_rays", all);
        }
        Ok(desc.pass(pass).parameters(block))
    }
}

/// What the shaders of all passes know.
const PARAMETERS: &str = include_str!("rectify_parameters.wgsl");

/// Bytes of the largest storage buffer that every device can bind.
const LARGEST_BUFFER: u64 = 128 << 20;

impl RectifyMoments {
    /// Slots and passes that tell which view rays the picture has.
    fn view_rays(
        &self,
        camera: &TextureDesc,
        upstream: &Connected<'_>,
    ) -> Result<([Slot; 2], [Pass; 3]), GraphError> {
        let [columns, rows] = self.extent;
        // A least and a largest depth for each texel.
        let size = u64::from(columns) * u64::from(rows) * 8;
        if size > LARGEST_BUFFER {
            return Err(wrong_property(format!(
                "'extent' is {columns}x{rows}; with 'camera_depth' it has at most {} texels, such as 4096x4096",
                LARGEST_BUFFER / 8
            )));
        }
        let link = |shader| {
            let extent = format_args!("vec2u({columns}u, {rows}u)");
            let specialization = Specialization::new(upstream.capabilities())
                .constant("EXTENT", extent)
                .module("rectify_parameters", PARAMETERS)
                .module(
                    "scattering_ray",
                    include_str!("../shared/scattering_ray.wgsl"),
                );
            depth_input::of_camera(specialization, camera).link(shader)
        };
        let pass = |label: &str, covers, texels, wgsl| {
            Pass::compute(label, covers, texels)
                .shader(wgsl, &label.replace(' ', "_"))
                .bind("view_ray_codes", bind::buffer("codes"))
        };
        let clear = link(wgsl!("clear_codes.wgsl"))?;
        let find = link(wgsl!("find_ends.wgsl"))?;
        let bound = link(wgsl!("bound_rays.wgsl"))?;
        let rays = TextureRule::new(TextureFormat::Rg32Uint).extent(self.extent);
        let codes = SlotResource::Buffer {
            access: Access::READ.union(Access::STORAGE_WRITE),
            size,
        };
        Ok((
            [
                Slot::output(
                    "view_rays",
                    "Which view rays of the picture pass each texel, and which end there.",
                    rays,
                ),
                Slot::internal(
                    "codes",
                    "The depths of the view rays that end in each texel.",
                    codes,
                ),
            ],
            [
                pass("clear codes", "view_rays", [8, 8], clear),
                pass("find ends", "camera_depth", [8, 8], find)
                    .bind("parameters", bind::parameters())
                    .bind("camera_depth", bind::layer("camera_depth")),
                pass("bound rays", "view_rays", [regions::ENDLESS, 1], bound)
                    .bind("parameters", bind::parameters())
                    .bind("view_rays_map", bind::store("view_rays")),
            ],
        ))
    }
}
