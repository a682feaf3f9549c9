//! Sums of a map of moments over rectangles, in constant time: a summed-area table.

use moment_shadows::{MapEncoding, Storage, SummedAreaTable as TableEncoding};
use serde::{Deserialize, Serialize};

use super::shared::{Specialization, map_input, regions, wgsl};
use super::techniques;
use crate::{Connected, GraphError, Node, NodeDesc, Pass, Stage, TextureRule, bind, same_as};

/// Node `summed_area_table`: `map` (four moments or two, of any storage, straight from a resolve) to `table`, of the same
/// size, layers and regions: in each texel of a region the sum of all its texels that lie neither below nor to the right,
/// modulo 2^32 (Crow, SIGGRAPH 1984). What the integers mean is in the encoding of `table`
/// ([`MapEncoding::table`]); the WGSL module `summed_area_table` looks up means of rectangles.
///
/// The map is read twice and the table written once (Nehab et al., SIGGRAPH Asia 2011): first the sums of tiles, one per
/// invocation and without any shared memory; then their prefix sums along rows and columns; then the table. On a software
/// adapter tiles have 16x16 texels, elsewhere 8x16, so that a map of 1024x1024 texels keeps 8192 invocations busy.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SummedAreaTable {
    /// The largest rectangle whose mean will be asked for. The smaller it is, the finer is the table of a float map and the
    /// less light leaks.
    #[serde(default)]
    pub largest_kernel: LargestKernel,
}

/// Width and height of the largest kernel in texels: as a graph file gives them, a number for a square or both.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum LargestKernel {
    /// Texels along each side.
    Square(u32),
    /// Texels in x and in y.
    Sides([u32; 2]),
}

impl LargestKernel {
    /// Texels in x and in y.
    #[must_use]
    pub fn sides(self) -> [u32; 2] {
        match self {
            LargestKernel::Square(side) => [side; 2],
            LargestKernel::Sides(sides) => sides,
        }
    }
}

impl Default for LargestKernel {
    /// 65x65 texels: the moment bias of a float32 map's table is then 2.8e-6.
    fn default() -> Self {
        LargestKernel::Square(65)
    }
}

/// Texels of a tile, and invocations of a workgroup.
struct Tiles {
    tile: [u32; 2],
    workgroup: [u32; 2],
}

/// A processor has few threads and many registers, if caches count: large tiles save most of what lies in between.
const OF_SOFTWARE: Tiles = Tiles {
    tile: [16, 16],
    workgroup: [8, 2],
};

/// Eight sums of four channels are 32 registers.
const OF_HARDWARE: Tiles = Tiles {
    tile: [8, 16],
    workgroup: [8, 8],
};

/// Lines per workgroup of the passes in between (`LINES` in WGSL).
const LINES: u32 = 64;

/// Texels that one line may have: more than any texture.
const ENDLESS: u32 = 65536;

impl Node for SummedAreaTable {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, source) = map_input::connected(upstream, "map")?;
        let table = TableEncoding::new(source.storage(), self.largest_kernel.sides())
            .map_err(techniques::property)?;
        let encoding = MapEncoding::of_table(source.technique().clone(), table)
            .map_err(|error| techniques::property(error).at_slot("map"))?;
        let tiles = if upstream.capabilities().software_adapter {
            OF_SOFTWARE
        } else {
            OF_HARDWARE
        };
        let (channels, integers) = sums(&source);
        let pair = |[x, y]: [u32; 2]| format!("vec2u({x}u, {y}u)");
        let storage = format!("texture_storage_2d<{}, write>", encoding.format());
        let specialization = Specialization::new(upstream.capabilities())
            .alias("SumsStorage", &storage)
            .unsigned("STORAGE", source.storage().wgsl_index())
            .unsigned("UNIT", table.unit())
            .unsigned("CHANNELS", channels)
            .constant("TILE", &pair(tiles.tile))
            .constant("WORKGROUP", &pair(tiles.workgroup));
        let specialization = regions::specialize(specialization, map);
        // One row or column per tile.
        let [across, down] = [0, 1].map(|axis| map.size[axis].div_ceil(tiles.tile[axis]));
        let [width, height] = map.size;
        let between = |size: [u32; 2]| {
            TextureRule::new(encoding.format())
                .extent(size)
                .layers(same_as("map"))
        };
        Ok(NodeDesc::new("summed_area_table", Stage::AfterShadowMaps)
            // Only the first mip level of a map is summed up.
            .input(
                "map",
                "The map to sum up.",
                map_input::rule(&map_input::FORMATS),
            )
            .internal(
                "row_sums",
                "The sum of each tile's rows.",
                between([across, height]),
            )
            .internal(
                "row_prefixes",
                "Their sums from the left.",
                between([across, height]),
            )
            .internal(
                "column_sums",
                "The sum of each tile's columns.",
                between([width, down]),
            )
            .internal(
                "column_prefixes",
                "Their sums from the top.",
                between([width, down]),
            )
            .output(
                "table",
                "The sum of all texels of a region that lie neither below nor to the right.",
                TextureRule::new(encoding.clone()).like("map"),
            )
            .passes(tiles.passes(&specialization, integers)?))
    }
}

impl Tiles {
    fn passes(
        &self,
        specialization: &Specialization,
        integers: &str,
    ) -> Result<[Pass; 4], GraphError> {
        let modules = [
            regions::TILE,
            ("sums", include_str!("sums.wgsl")),
            ("source", integers),
            ("tile_columns", include_str!("tile_columns.wgsl")),
        ];
        let tile = [0, 1].map(|axis| self.tile[axis] * self.workgroup[axis]);
        let pass = |label: &str, shader, entry_point: &str, texels| {
            let wgsl = specialization.link(shader, &modules)?;
            let pass = regions::compute(label, "table", 0, texels);
            Ok::<_, GraphError>(pass.shader(wgsl, entry_point))
        };
        Ok([
            pass("sum tiles", wgsl!("tile_sums.wgsl"), "sum_tiles", tile)?
                .bind("moments_map", bind::layer("map"))
                .bind("target_map", bind::store("column_sums"))
                .bind("row_sums", bind::store("row_sums")),
            pass(
                "sum rows",
                wgsl!("row_prefixes.wgsl"),
                "sum_rows",
                [ENDLESS, LINES],
            )?
            .bind("row_sums", bind::layer("row_sums"))
            .bind("target_map", bind::store("row_prefixes")),
            pass(
                "sum columns",
                wgsl!("column_prefixes.wgsl"),
                "sum_columns",
                [LINES, ENDLESS],
            )?
            .bind("column_sums", bind::layer("column_sums"))
            .bind("target_map", bind::store("column_prefixes"))
            .bind("row_prefixes", bind::layer("row_prefixes")),
            pass("make table", wgsl!("table.wgsl"), "make_table", tile)?
                .bind("moments_map", bind::layer("map"))
                .bind("target_map", bind::store("table"))
                .bind("row_prefixes", bind::layer("row_prefixes"))
                .bind("column_prefixes", bind::layer("column_prefixes")),
        ])
    }
}

/// How many channels are summed up, and how a texel becomes integers: those of two or four moments.
fn sums(source: &MapEncoding) -> (u32, &'static str) {
    let channels = source.technique().row().channels;
    let integers = if source.storage() == Storage::Unorm16 {
        include_str!("source_unorm16.wgsl")
    } else if channels == 2 {
        include_str!("source_variance.wgsl")
    } else {
        include_str!("source_four_moments.wgsl")
    };
    (channels, integers)
}
