//! Sums of a map of moments over rectangles, in constant time: a summed-area table.

mod tile_columns;

use moment_shadows::{MapEncoding, Storage, SummedAreaTable as TableEncoding, Technique};
use serde::{Deserialize, Serialize};

use super::moments_input::{map_formats, moments_input};
use super::specialization::Specialization;
use super::{region_tiles, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, Lifetime, Node, NodeDesc, Pass, Slot, SlotResource, Stage, Work,
};

/// Node `summed_area_table`: `moments` (four of them or two, of any storage, straight from a resolve) to `table`, of the same
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
        let (moments, source) = moments_input(upstream)?;
        let table = TableEncoding::new(source.storage(), self.largest_kernel.sides())
            .map_err(techniques::property)?;
        let encoding = MapEncoding::of_table(source.technique().clone(), table)
            .map_err(|error| techniques::property(error).at_slot("map"))?;
        let tiles = if upstream.capabilities().software_adapter {
            OF_SOFTWARE
        } else {
            OF_HARDWARE
        };
        let specialization = tiles.specialize(&source, &encoding, table, upstream);
        let specialization = region_tiles::specialize(specialization, moments);
        let slots = [0, 1].map(|axis| moments.size[axis].div_ceil(tiles.tile[axis]));
        let [width, height] = moments.size;
        Ok(NodeDesc {
            name: "summed_area_table".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: vec![
                slot(
                    "map",
                    Direction::In,
                    Access::READ,
                    FormatRule::OneOf(map_formats()),
                    ExtentRule::Any,
                ),
                between("row_sums", &encoding, [slots[0], height]),
                between("row_prefixes", &encoding, [slots[0], height]),
                between("column_sums", &encoding, [width, slots[1]]),
                between("column_prefixes", &encoding, [width, slots[1]]),
                slot(
                    "table",
                    Direction::Out,
                    Access::STORAGE_WRITE,
                    FormatRule::Encoded(encoding.clone()),
                    ExtentRule::SameAs("map".to_owned()),
                ),
            ],
            passes: tiles.passes(&specialization, &source, &encoding)?,
            parameters: None,
        })
    }
}

impl Tiles {
    fn specialize(
        &self,
        source: &MapEncoding,
        encoding: &MapEncoding,
        table: TableEncoding,
        upstream: &Connected<'_>,
    ) -> Specialization {
        let pair = |[x, y]: [u32; 2]| format!("vec2u({x}u, {y}u)");
        Specialization::new(upstream.capabilities())
            .alias(
                "SumsStorage",
                &format!("texture_storage_2d<{}, write>", encoding.format()),
            )
            .constant("STORAGE", &format!("{}u", source.storage().wgsl_index()))
            .constant("UNIT", &format!("{}u", table.unit()))
            .constant("TILE", &pair(self.tile))
            .constant("WORKGROUP", &pair(self.workgroup))
    }

    fn passes(
        &self,
        specialization: &Specialization,
        source: &MapEncoding,
        encoding: &MapEncoding,
    ) -> Result<Vec<Pass>, GraphError> {
        let columns = tile_columns::columns(self.tile[0]);
        let modules = [
            region_tiles::MODULE,
            ("sums", sums(encoding)),
            ("source", source_integers(source)),
            (
                "sums_target",
                include_str!("summed_area_table/sums_target.wgsl"),
            ),
            (tile_columns::MODULE, &columns),
        ];
        let tile = [0, 1].map(|axis| self.tile[axis] * self.workgroup[axis]);
        let pass = |label: &str, file: &str, shader: &str, entry_point: &str, texels, bound| {
            let bindings = (0..)
                .zip(bound)
                .map(|(binding, resource)| Binding { binding, resource })
                .chain([region_tiles::binding("table", 1)])
                .collect();
            Ok::<_, GraphError>(Pass {
                label: label.to_owned(),
                wgsl: specialization.link(file, shader, &modules)?,
                entry_point: entry_point.to_owned(),
                bindings,
                constants: [].into(),
                plane: 0,
                work: Work::ComputeRegions {
                    covers: "table".to_owned(),
                    level: 0,
                    texels_per_workgroup: texels,
                },
            })
        };
        let read = |slot: &str| BindingResource::Layer(slot.to_owned());
        let write = |slot: &str| BindingResource::StorageLayer(slot.to_owned());
        Ok(vec![
            pass(
                "sum tiles",
                "tile_sums.wgsl",
                include_str!("summed_area_table/tile_sums.wgsl"),
                "sum_tiles",
                tile,
                vec![read("map"), write("column_sums"), write("row_sums")],
            )?,
            pass(
                "sum rows",
                "row_prefixes.wgsl",
                include_str!("summed_area_table/row_prefixes.wgsl"),
                "sum_rows",
                [ENDLESS, LINES],
                vec![read("row_sums"), write("row_prefixes")],
            )?,
            pass(
                "sum columns",
                "column_prefixes.wgsl",
                include_str!("summed_area_table/column_prefixes.wgsl"),
                "sum_columns",
                [LINES, ENDLESS],
                vec![
                    read("column_sums"),
                    write("column_prefixes"),
                    read("row_prefixes"),
                ],
            )?,
            pass(
                "make table",
                "table.wgsl",
                include_str!("summed_area_table/table.wgsl"),
                "make_table",
                tile,
                vec![
                    read("map"),
                    write("table"),
                    read("row_prefixes"),
                    read("column_prefixes"),
                ],
            )?,
        ])
    }
}

/// How many channels are summed up.
fn sums(encoding: &MapEncoding) -> &'static str {
    match encoding.technique() {
        Technique::Vsm => include_str!("summed_area_table/two_channels.wgsl"),
        _ => include_str!("summed_area_table/four_channels.wgsl"),
    }
}

/// How a texel becomes integers.
fn source_integers(source: &MapEncoding) -> &'static str {
    match (source.storage(), source.technique()) {
        (Storage::Unorm16, _) => include_str!("summed_area_table/source_unorm16.wgsl"),
        (_, Technique::Vsm) => include_str!("summed_area_table/source_variance.wgsl"),
        _ => include_str!("summed_area_table/source_four_moments.wgsl"),
    }
}

/// A texture that passes hand on sums in: one row or column per tile.
fn between(name: &str, encoding: &MapEncoding, size: [u32; 2]) -> Slot {
    slot(
        name,
        Direction::Internal,
        Access::READ.union(Access::STORAGE_WRITE),
        FormatRule::Exact(encoding.format()),
        ExtentRule::Exact(size),
    )
}

fn slot(
    name: &str,
    direction: Direction,
    access: Access,
    format: FormatRule,
    extent: ExtentRule,
) -> Slot {
    let (layers, mips) = match direction {
        // Of a map with mip levels the first is summed up.
        Direction::In => (CountRule::Any, CountRule::Any),
        _ => (CountRule::SameAs("map".to_owned()), CountRule::Exact(1)),
    };
    Slot {
        name: name.to_owned(),
        direction,
        lifetime: Lifetime::Frame,
        optional: false,
        resource: SlotResource::Texture {
            access,
            format,
            extent,
            layers,
            mips,
            samples: CountRule::Exact(1),
        },
    }
}
