import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::filter::summed_area_table::{SummedAreaTableRectangle, summed_area_table_mean_interpolated, summed_area_table_mean_plain, summed_area_table_rectangle};

// Means of rectangles of a table, one per invocation.

struct Query {
    region: MapRegion,
    centre: vec2f,
    half_extent: vec2f,
    largest: vec2f,
    interpolated: u32,
    unit: f32,
}

struct Mean {
    rectangle: SummedAreaTableRectangle,
    mean: vec4f,
}

@group(0) @binding(0) var<storage, read> queries: array<Query>;
@group(0) @binding(1) var<storage, read_write> means: array<Mean>;
@group(0) @binding(2) var table: texture_2d_array<u32>;

@compute @workgroup_size(64)
fn look_up(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&queries) {
        return;
    }
    let query = queries[id.x];
    let rectangle = summed_area_table_rectangle(query.region, query.centre, query.half_extent, query.largest);
    var mean = summed_area_table_mean_interpolated(table, 0u, query.region, rectangle, query.unit);
    if query.interpolated == 0u {
        mean = summed_area_table_mean_plain(table, 0u, query.region, rectangle, query.unit);
    }
    means[id.x] = Mean(rectangle, mean);
}
