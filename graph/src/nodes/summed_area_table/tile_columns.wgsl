import moment_shadows::filter::prefix_sum::{PrefixSumFour, prefix_sum_across, prefix_sum_along};
import node::source::{source_integers};
import node::specialization::{GROUP, TILE};
import node::sums::{sums_load_four, sums_store_four};

// The columns of a tile: one sum per column is held in registers. Columns beyond the map or the region hold anything: sums go
// to the right and down only, and `store_columns` leaves them out.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

// Sums of the 8 or 16 columns of a tile; the latter half is unused in a tile of 8.
struct TileColumns {
    c0: PrefixSumFour,
    c4: PrefixSumFour,
    c8: PrefixSumFour,
    c12: PrefixSumFour,
}

fn load_texel(texel: vec2u) -> vec4u {
    return source_integers(textureLoad(moments_map, texel, 0));
}

fn load_four_texels(first: vec2u) -> PrefixSumFour {
    return PrefixSumFour(
        load_texel(first),
        load_texel(first + vec2u(1u, 0u)),
        load_texel(first + vec2u(2u, 0u)),
        load_texel(first + vec2u(3u, 0u)),
    );
}

// Adds the texels of a row up to each column, from the texel `first` on.
fn add_row(first: vec2u, columns: TileColumns) -> TileColumns {
    let r0 = prefix_sum_along(vec4u(0u), load_four_texels(first));
    let r4 = prefix_sum_along(r0.s3, load_four_texels(first + vec2u(4u, 0u)));
    var sums = columns;
    sums.c0 = prefix_sum_across(columns.c0, r0);
    sums.c4 = prefix_sum_across(columns.c4, r4);
    if TILE.x == 16u {
        let r8 = prefix_sum_along(r4.s3, load_four_texels(first + vec2u(8u, 0u)));
        let r12 = prefix_sum_along(r8.s3, load_four_texels(first + vec2u(12u, 0u)));
        sums.c8 = prefix_sum_across(columns.c8, r8);
        sums.c12 = prefix_sum_across(columns.c12, r12);
    }
    return sums;
}

// The sum of all columns up to the last.
fn last_column(columns: TileColumns) -> vec4u {
    if TILE.x == 16u {
        return columns.c12.s3;
    }
    return columns.c4.s3;
}

// The columns that begin as the texels of `map` from `first` on.
fn load_columns(map: texture_2d<u32>, first: vec2u) -> TileColumns {
    var columns: TileColumns;
    columns.c0 = sums_load_four(map, first);
    columns.c4 = sums_load_four(map, first + vec2u(4u, 0u));
    if TILE.x == 16u {
        columns.c8 = sums_load_four(map, first + vec2u(8u, 0u));
        columns.c12 = sums_load_four(map, first + vec2u(12u, 0u));
    }
    return columns;
}

// Stores the first `count` columns, one at least, each with `added`.
fn store_columns(first: vec2u, count: u32, columns: TileColumns, added: vec4u) {
    let more = PrefixSumFour(added, added, added, added);
    sums_store_four(first, count, prefix_sum_across(columns.c0, more));
    if 4u < count {
        sums_store_four(first + vec2u(4u, 0u), count - 4u, prefix_sum_across(columns.c4, more));
    }
    if TILE.x == 16u && 8u < count {
        sums_store_four(first + vec2u(8u, 0u), count - 8u, prefix_sum_across(columns.c8, more));
    }
    if TILE.x == 16u && 12u < count {
        sums_store_four(first + vec2u(12u, 0u), count - 12u, prefix_sum_across(columns.c12, more));
    }
}
