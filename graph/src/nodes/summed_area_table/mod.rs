//! Sums of a map of moments over rectangles, in constant time: a summed-area table.

use moment_shadows::{MapEncoding, Storage, SummedAreaTable as TableEncoding};
use serde::{Deserialize, Deserializer};

use super::shared::regions::ENDLESS;
use super::shared::{Specialization, map_input, wgsl, wrong_property};
use crate::{Connected, GraphError, Node, NodeDesc, Pass, Slot, Stage, TextureRule, bind};

/// Node `summed_area_table`: `map` (four moments or two, of any storage, straight from a resolve) to `table`, of the same
/// size, layers and regions: in each texel of a region the sum of all its texels that lie neither below nor to the right,
/// modulo 2^32 (Crow, SIGGRAPH 1984). What the integers mean is in the encoding of `table`
/// ([`MapEncoding::table`]); the WGSL module `summed_area_table` looks up means of rectangles.
///
/// The map is read twice and the table written once (Nehab et al., SIGGRAPH Asia 2011): first the sums of tiles, one per
/// invocation and without any shared memory; then their prefix sums along rows and columns; then the table. On a software
/// adapter tiles have 16x16 texels, elsewhere 8x16, so that a map of 1024x1024 texels keeps 8192 invocations busy.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct SummedAreaTable {
    /// Width and height in texels of the largest rectangle whose mean will be asked for, in a file one number for a square. The
    /// smaller it is, the finer is the table of a float map and the less light leaks.
    #[serde(deserialize_with = "sides")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "sides_schema", extend("default" = 65)))]
    pub largest_kernel: [u32; 2],
}

impl Default for SummedAreaTable {
    /// 65x65 texels: the moment bias of a float32 map's table is then 2.8e-6.
    fn default() -> Self {
        Self {
            largest_kernel: [65; 2],
        }
    }
}

fn sides<'de, D: Deserializer<'de>>(file: D) -> Result<[u32; 2], D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged)]
    enum Written {
        Square(u32),
        Sides([u32; 2]),
    }
    Ok(match Written::deserialize(file)? {
        Written::Square(side) => [side; 2],
        Written::Sides(sides) => sides,
    })
}

#[cfg(feature = "schema")]
fn sides_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    let side = schemars::json_schema!({ "type": "integer", "minimum": 1 });
    let sides =
        schemars::json_schema!({ "type": "array", "items": side, "minItems": 2, "maxItems": 2 });
    schemars::json_schema!({ "anyOf": [side, sides] })
}

/// Lines per workgroup of the passes in between (`LINES` in WGSL).
const LINES: u32 = 64;

impl Node for SummedAreaTable {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, source) = map_input::connected(upstream, "map")?;
        map_input::refuse_blended(&source)?;
        map_input::refuse_packed(&source)?;
        let table =
            TableEncoding::new(source.storage(), self.largest_kernel).map_err(wrong_property)?;
        let encoding = MapEncoding::of_table(source.technique().clone(), table)
            .map_err(|error| wrong_property(error).at_slot("map"))?;
        // Texels of a tile, and invocations of a workgroup.
        let (tile, workgroup) = if upstream.capabilities().software_adapter {
            // A processor has few threads and many registers, if caches count: large tiles save most of what lies in between.
            ([16, 16], [8, 2])
        } else {
            // Eight sums of four channels are 32 registers.
            ([8, 16], [8, 8])
        };
        let integers = if source.storage() == Storage::Unorm16 {
            include_str!("source_unorm16.wgsl")
        } else {
            include_str!("source_float.wgsl")
        };
        let row = source.technique().row();
        let storage = format!("texture_storage_2d<{}, write>", encoding.format());
        let specialization = Specialization::new(upstream.capabilities())
            .alias("SumsStorage", &storage)
            .unsigned("SOURCE_STORAGE", source.storage().wgsl_index())
            .unsigned("STORAGE", Storage::Unorm16.wgsl_index())
            .unsigned("UNIT", table.unit())
            .unsigned("CHANNELS", row.channels)
            .unsigned("REGIONS", map.regions)
            .pair("TILE", tile)
            .unsigned("WORKGROUP_X", workgroup[0])
            .unsigned("WORKGROUP_Y", workgroup[1])
            .module("sums", include_str!("sums.wgsl"))
            .module("source", integers)
            .module("map_encoding", row.map_encoding())
            .module("tile_columns", include_str!("tile_columns.wgsl"));
        let pass = |label: &str, shader, texels| {
            let pass = Pass::compute(label, "table", texels)
                .over_regions(0)
                .bind("regions", bind::regions("table", 1));
            let wgsl = specialization.link(shader)?;
            Ok::<_, GraphError>(pass.shader(wgsl, &label.replace(' ', "_")))
        };
        let between = |name: &str, description: &str, per: [u32; 2]| {
            let rule = TextureRule::new(encoding.format());
            Slot::internal(name, description, rule.tiles_of("map", per))
        };
        // One row or column per tile.
        let (rows, columns) = ([tile[0], 1], [1, tile[1]]);
        // Only the first mip level of a map is summed up.
        let rule = map_input::rule(map_input::formats());
        let whole = TextureRule::of_map(encoding.clone())
            .like("map")
            .filtered(map.deviation)
            .filtered_in_scene(map.width)
            .fitted_to("map");
        let description =
            "The sum of all texels of a region that lie neither below nor to the right.";
        let tiles = [0, 1].map(|axis| tile[axis] * workgroup[axis]);
        Ok(NodeDesc::new("summed_area_table", Stage::AfterShadowMaps)
            .input("map", "The map to sum up.", rule)
            .slots([
                between("row_sums", "The sum of each tile's rows.", rows),
                between("row_prefixes", "Their sums from the left.", rows),
                between("column_sums", "The sum of each tile's columns.", columns),
                between("column_prefixes", "Their sums from the top.", columns),
            ])
            .output("table", description, whole)
            .passes([
                pass("sum tiles", wgsl!("tile_sums.wgsl"), tiles)?
                    .bind("moments_map", bind::layer("map"))
                    .bind("target_map", bind::store("column_sums"))
                    .bind("row_sums", bind::store("row_sums")),
                pass("sum rows", wgsl!("row_prefixes.wgsl"), [ENDLESS, LINES])?
                    .bind("row_sums", bind::layer("row_sums"))
                    .bind("target_map", bind::store("row_prefixes")),
                pass(
                    "sum columns",
                    wgsl!("column_prefixes.wgsl"),
                    [LINES, ENDLESS],
                )?
                .bind("column_sums", bind::layer("column_sums"))
                .bind("target_map", bind::store("column_prefixes"))
                .bind("row_prefixes", bind::layer("row_prefixes")),
                pass("make table", wgsl!("table.wgsl"), tiles)?
                    .bind("moments_map", bind::layer("map"))
                    .bind("target_map", bind::store("table"))
                    .bind("row_prefixes", bind::layer("row_prefixes"))
                    .bind("column_prefixes", bind::layer("column_prefixes")),
            ]))
    }
}
