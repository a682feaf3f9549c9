//! Which views may contain a pixel, found for each tile of the picture where there are many: a pixel then pays for those alone.

use moment_shadows::TextureFormat;

use super::shading::numbered;
use super::{Specialization, wgsl};
use crate::{Binding, GraphError, Pass, Slot, TextureRule, bind};

/// From so many views on a pass finds those of each tile. With fewer, each pixel tests all of them for less.
const FEWEST: u32 = 8;

/// Pixels of a tile along each side: with as many invocations as core WebGPU allows in a workgroup.
const TILE: u32 = 16;

/// Views of a texel: a bit for each.
const PER_TEXEL: u32 = 128;

/// The lists of views of a node that shades.
pub(super) struct Tiled {
    views: u32,
    /// The node's map.
    map: Vec<Binding>,
}

impl Tiled {
    /// For so many views of a map with these bindings.
    pub(super) fn new(views: u32, map: Vec<Binding>) -> Self {
        Self { views, map }
    }

    /// The first view of each list; none where there are few views.
    fn firsts(&self) -> impl Iterator<Item = u32> + use<> {
        let views = if self.views < FEWEST { 0 } else { self.views };
        (0..views).step_by(PER_TEXEL as usize)
    }

    /// The module by which a pixel goes through views.
    pub(super) fn list(&self, specialization: Specialization) -> Specialization {
        let words = match self.firsts().count() {
            0 => return specialization.module("view_list", include_str!("view_list_all.wgsl")),
            1 => include_str!("tile_words_one.wgsl"),
            _ => include_str!("tile_words_two.wgsl"),
        };
        specialization
            .constant("TILE", TILE)
            .module("tile_words", words)
            .module("view_list", include_str!("view_list_tiles.wgsl"))
    }

    /// Where lists are kept until the picture is shaded.
    pub(super) fn slots(&self) -> impl Iterator<Item = Slot> + use<> {
        self.firsts().map(|first| {
            let rule = TextureRule::new(TextureFormat::Rgba32Uint);
            let rule = rule.tiles_of("camera_depth", [TILE; 2]);
            let description =
                "The views that may contain a pixel of each tile, a bit for each of 128.";
            Slot::internal(&numbered("tile_views", first), description, rule)
        })
    }

    /// What a pass that shades reads.
    pub(super) fn bindings(&self) -> impl Iterator<Item = Binding> + use<> {
        self.firsts().map(|first| {
            let name = numbered("tile_views", first);
            Binding::new(&name, bind::layer(&name))
        })
    }

    /// The passes that find views.
    pub(super) fn passes(&self, specialization: &Specialization) -> Result<Vec<Pass>, GraphError> {
        if self.views < FEWEST {
            return Ok(Vec::new());
        }
        let specialization = specialization.clone().constant("TILE", TILE);
        let wgsl = specialization.link(wgsl!("find_views.wgsl"))?;
        // The map, for its size; without its sampler.
        let map = self.map.first().cloned();
        let passes = self.firsts().map(|first| {
            let label = numbered("find views", first);
            let mut pass = Pass::compute(label, "camera_depth", [TILE; 2])
                .shader(wgsl.as_str(), "find_views")
                .bind("views", bind::parameters())
                .bind("camera_depth", bind::layer("camera_depth"))
                .bind("found_views", bind::store(&numbered("tile_views", first)));
            if first > 0 {
                pass = pass.constant("FIRST_VIEW", first);
            }
            pass.bindings.extend(map.clone());
            pass
        });
        Ok(passes.collect())
    }
}
