import node::fullscreen::{Interpolated};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::filter::summed_area_table::{summed_area_table_mean_interpolated, summed_area_table_rectangle};

// What filtering with a summed-area table costs: the mean over a rectangle of any size, interpolated. Another subject has the
// mean over whole texels in its place.

struct Filter {
    region: MapRegion,
    half_extent: vec2f,
    largest: vec2f,
    unit: f32,
}

@group(0) @binding(0) var table: texture_2d_array<u32>;
@group(0) @binding(1) var<uniform> kernel: Filter;

@fragment
fn shade(input: Interpolated) -> @location(0) vec4f {
    let centre = vec2f(kernel.region.origin) + input.place.xy * vec2f(kernel.region.extent);
    let rectangle = summed_area_table_rectangle(kernel.region, centre, kernel.half_extent, kernel.largest);
    return summed_area_table_mean_interpolated(table, 0u, kernel.region, rectangle, kernel.unit);
}
