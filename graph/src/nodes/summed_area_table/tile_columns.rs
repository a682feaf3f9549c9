//! Unrolled bodies for the columns of a tile: one sum per column is held in registers.
//!
//! The text is generated because a loop over an array of sums is not reliably kept in registers by shader compilers.

use core::fmt::Write;

/// The name of the generated module.
pub(super) const MODULE: &str = "tile_columns";

/// What it imports, and the map that is summed up.
const HEAD: &str = "\
import node::source::{source_integers};
import node::specialization::{GROUP};
import node::sums::{Sums, sums_of, sums_texel};
import node::sums_target::{target_map};

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

";

/// `struct TileColumns` with a sum per column, and functions on it. Columns beyond the map or the region hold anything: sums go
/// to the right and down only, and `store_columns` leaves them out.
///
/// - `add_row(first, columns) -> TileColumns` adds the texels of a row up to each column, from the texel `first` on;
/// - `last_column(columns) -> Sums`, the sum of them all;
/// - `load_columns(map, first) -> TileColumns`;
/// - `store_columns(first, count, columns, added)` stores the first `count` of them.
pub(super) fn columns(width: u32) -> String {
    let mut text = HEAD.to_owned();
    let mut fields = String::new();
    let mut add = String::new();
    let mut load = String::new();
    let mut store = String::new();
    // Writing to a string cannot fail.
    for column in 0..width {
        let place = format!("first + vec2u({column}u, 0u)");
        let _ = writeln!(fields, "    c{column}: Sums,");
        let texel = format!("sums_of(source_integers(textureLoad(moments_map, {place}, 0)))");
        let _ = match column.checked_sub(1) {
            None => writeln!(add, "    let t0 = {texel};"),
            Some(before) => writeln!(add, "    let t{column} = t{before} + {texel};"),
        };
        let _ = writeln!(load, "        sums_of(textureLoad(map, {place}, 0)),");
        let _ = writeln!(
            store,
            "    if {column}u < count {{\n        textureStore(target_map, {place}, sums_texel(columns.c{column} + added));\n    }}"
        );
    }
    let sums: Vec<String> = (0..width)
        .map(|column| format!("columns.c{column} + t{column}"))
        .collect();
    let _ = write!(
        text,
        "struct TileColumns {{\n{fields}}}\n\n\
         fn add_row(first: vec2u, columns: TileColumns) -> TileColumns {{\n{add}    return TileColumns({});\n}}\n\n\
         fn last_column(columns: TileColumns) -> Sums {{\n    return columns.c{};\n}}\n\n\
         fn load_columns(map: texture_2d<u32>, first: vec2u) -> TileColumns {{\n    return TileColumns(\n{load}    );\n}}\n\n\
         fn store_columns(first: vec2u, count: u32, columns: TileColumns, added: Sums) {{\n{store}}}\n",
        sums.join(", "),
        width - 1
    );
    text
}
