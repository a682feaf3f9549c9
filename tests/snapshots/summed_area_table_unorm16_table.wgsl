// What is linked of files:
// moment_shadows/map/map_region.wgsl: MapRegion map_region_within map_region_at_level
// region_tile: regions RegionTile region_tile
// sums: Sums sums_of sums_texel
// sums_target: target_map
// moment_shadows/filter/summed_area_encoding.wgsl: summed_area_encoding_of_unorm16
// source: source_integers
// table.wgsl: row_prefixes column_prefixes make_table

// specialization
const GROUP = 0;
alias SumsStorage = texture_storage_2d<rgba32uint, write>;

const TILE = vec2u(8u, 16u);
const WORKGROUP = vec2u(8u, 8u);
const REGIONS = 1u;

// tile_columns
@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

struct TileColumns {
    c0: Sums,
    c1: Sums,
    c2: Sums,
    c3: Sums,
    c4: Sums,
    c5: Sums,
    c6: Sums,
    c7: Sums,
}

fn add_row(first: vec2u, columns: TileColumns) -> TileColumns {
    let t0 = sums_of(source_integers(textureLoad(moments_map, first + vec2u(0u, 0u), 0)));
    let t1 = t0 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(1u, 0u), 0)));
    let t2 = t1 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(2u, 0u), 0)));
    let t3 = t2 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(3u, 0u), 0)));
    let t4 = t3 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(4u, 0u), 0)));
    let t5 = t4 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(5u, 0u), 0)));
    let t6 = t5 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(6u, 0u), 0)));
    let t7 = t6 + sums_of(source_integers(textureLoad(moments_map, first + vec2u(7u, 0u), 0)));
    return TileColumns(columns.c0 + t0, columns.c1 + t1, columns.c2 + t2, columns.c3 + t3, columns.c4 + t4, columns.c5 + t5, columns.c6 + t6, columns.c7 + t7);
}

fn load_columns(map: texture_2d<u32>, first: vec2u) -> TileColumns {
    return TileColumns(
        sums_of(textureLoad(map, first + vec2u(0u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(1u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(2u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(3u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(4u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(5u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(6u, 0u), 0)),
        sums_of(textureLoad(map, first + vec2u(7u, 0u), 0)),
    );
}

fn store_columns(first: vec2u, count: u32, columns: TileColumns, added: Sums) {
    if 0u < count {
        textureStore(target_map, first + vec2u(0u, 0u), sums_texel(columns.c0 + added));
    }
    if 1u < count {
        textureStore(target_map, first + vec2u(1u, 0u), sums_texel(columns.c1 + added));
    }
    if 2u < count {
        textureStore(target_map, first + vec2u(2u, 0u), sums_texel(columns.c2 + added));
    }
    if 3u < count {
        textureStore(target_map, first + vec2u(3u, 0u), sums_texel(columns.c3 + added));
    }
    if 4u < count {
        textureStore(target_map, first + vec2u(4u, 0u), sums_texel(columns.c4 + added));
    }
    if 5u < count {
        textureStore(target_map, first + vec2u(5u, 0u), sums_texel(columns.c5 + added));
    }
    if 6u < count {
        textureStore(target_map, first + vec2u(6u, 0u), sums_texel(columns.c6 + added));
    }
    if 7u < count {
        textureStore(target_map, first + vec2u(7u, 0u), sums_texel(columns.c7 + added));
    }
}

