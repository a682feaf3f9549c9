//! Fits the range of moment depth to the casters in a light's depth map.

use moment_shadows::{TextureFormat, ViewParameters};
use serde::Deserialize;

use super::shared::regions::ENDLESS;
use super::shared::{Specialization, depth_input, wgsl, wrong_size};
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, ParameterBlock, Pass, ResourceDesc, Rule, Slot,
    Stage, TextureRule, bind,
};

/// Texels of the depth map for each workgroup that looks through it, along each side.
const TILE: u32 = 32;

/// The pass of a node that knows what the camera sees.
pub(crate) const SEES: &str = "see tiles";

/// Pixels of the camera's picture that count as one, along each side.
const SEEN_TILE: u32 = 8;

/// Node `fit_range`: `depth` (as `resolve` takes it) to `ranges`, which `resolve` takes and then `shade_hard` or `shade_soft`, too.
/// Light leaks in proportion to the range of moment depth; with this node a host keeps a generous one, and each region of each
/// layer of its map gets what its casters need of it.
///
/// Each time a layer is dirty, the nearest and the farthest caster of each region are found. The range grows at once, and shrinks
/// where it is clearly too long: `ranges` is persistent. A region without casters keeps its range. Never does a range leave that of
/// the host. Receivers behind all casters count as lying at the far end; penumbrae of soft shadows are as wide there as at that
/// distance. Parameters: a [`moment_shadows::DepthConversion`] per layer and region, the same as those of `resolve`.
///
/// With the optional input `camera_depth` a range goes no farther than the camera sees: what lies behind casts no shadow on anything
/// that is shaded. The map is then made for one camera, and anew whenever that moves: all its layers are dirty. The camera's depth has to be
/// there when the stage is recorded, as after a depth prepass. Parameters: a [`ViewParameters`] per layer and region instead, the same as
/// those of `shade_hard`; its bias does not count, and the first one says which depth is no surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FitRange {}

impl Node for FitRange {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let depth = upstream.texture("depth")?;
        let [across, down] = depth.size.map(|side| side.div_ceil(TILE));
        if u64::from(across) * u64::from(down) < u64::from(depth.regions) {
            return Err(wrong_size(format!(
                "{} regions are more than {}x{} texels have tiles of {TILE}x{TILE}; describe the map with fewer regions",
                depth.regions, depth.size[0], depth.size[1]
            ))
            .at_slot("depth"));
        }
        let camera = upstream.get("camera_depth").and_then(ResourceDesc::texture);
        let specialization = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", depth_input::texture_type(depth))
            .unsigned("REGIONS", depth.regions)
            .constant("SAMPLES", depth.samples);
        let (specialization, seeing) = match camera {
            None => (
                specialization.module("seen", include_str!("seen_all.wgsl")),
                None,
            ),
            Some(camera) => {
                let specialization = depth_input::of_camera(specialization, camera)
                    .unsigned("VIEWS", depth.regions)
                    .unsigned("SEEN_TILE", SEEN_TILE)
                    .module("views", include_str!("../shared/views.wgsl"))
                    .module("seen", include_str!("seen_tiles.wgsl"));
                let wgsl = specialization.link(wgsl!("see_tiles.wgsl"))?;
                let see = Pass::compute(SEES, "camera_depth", [SEEN_TILE; 2])
                    .shader(wgsl, "see_tiles")
                    .bind("views", bind::parameters())
                    .bind("camera_depth", bind::layer("camera_depth"))
                    .bind("target_map", bind::store("tiles"));
                (specialization, Some(see))
            }
        };
        let wgsl = specialization.link(wgsl!("fit_range.wgsl"))?;
        // All passes follow the layers of the depth map; those of a single workgroup cover it whole.
        let pass = |label: &str, texels| {
            Pass::compute(label, "depth", texels)
                .each_layer()
                .shader(wgsl.as_str(), &label.replace(' ', "_"))
        };
        let of_regions = || {
            TextureRule::new(TextureFormat::Rgba32Float)
                .extent([depth.regions, 1])
                .layers(Rule::same_as("depth"))
        };
        let find = pass("find ends", [TILE; 2])
            .bind("depth_map", bind::layer("depth"))
            .bind("target_map", bind::store("ends"))
            .bind("regions", bind::regions("depth", 1));
        let (find, parameters) = match camera {
            None => (
                find.bind("conversions", bind::parameters()),
                depth_input::conversions(depth),
            ),
            Some(_) => (
                find.bind("views", bind::parameters())
                    .bind("tiles_map", bind::layers("tiles")),
                ParameterBlock::of::<ViewParameters>("ViewParameters")
                    .elements(depth.regions)
                    .each_layer_of("depth"),
            ),
        };
        let tiles = camera.map(|_| {
            let rule = TextureRule::new(TextureFormat::Rgba32Float);
            let rule = rule.tiles_of("camera_depth", [SEEN_TILE; 2]);
            Slot::internal(
                "tiles",
                "Between which depths the camera sees surfaces in each tile.",
                rule,
            )
        });
        let camera_depth = Slot::input(
            "camera_depth",
            "Where the camera sees surfaces: ranges go no farther.",
            depth_input::camera(),
        );
        let ends = TextureRule::new(TextureFormat::Rgba32Float).tiles_of("depth", [TILE; 2]);
        let ranges = "The range of each region: its middle, how many times the host's is as long, and where the region begins.";
        Ok(NodeDesc::new("fit_range", Stage::AfterShadowMaps)
            .input("depth", "The light's depth map.", depth_input::light())
            .slots([camera_depth.optional()])
            .slots([
                Slot::output("ranges", ranges, of_regions().fitted_to("ranges")).persistent(),
                Slot::internal("ends", "The ends of what each workgroup sees.", ends),
                Slot::internal("next", "The ranges of this frame.", of_regions()),
            ])
            .slots(tiles)
            .passes(seeing)
            .pass(find)
            .pass(
                pass("fit ranges", [ENDLESS; 2])
                    .bind("depth_map", bind::layer("depth"))
                    .bind("ranges_map", bind::layer("ranges"))
                    .bind("target_map", bind::store("next"))
                    .bind("ends_map", bind::layer("ends"))
                    .bind("regions", bind::regions("depth", 1)),
            )
            .pass(
                pass("keep ranges", [ENDLESS; 2])
                    .bind("ranges_map", bind::layer("next"))
                    .bind("target_map", bind::store("ranges")),
            )
            .parameters(parameters)
            // The host's ranges.
            .off("ranges", Off::Fill(vec![[0.0, 1.0, 0.0, 0.0]])))
    }
}
