import super::map_region::{MapRegion};

// Summed-area tables: the mean over any rectangle of a map, at a cost that does not depend on its size.
//
// A texel of the table is the sum of all texels of its region that lie neither below it nor to its right (Crow, SIGGRAPH
// 1984). Sums are integers modulo 2^32: they wrap around, and a rectangle's own sum is right nevertheless as long as it
// is below 2^32 (Hensley et al., Eurographics 2005). Channels are those of the storage unorm16, in [0, 1] times a `unit`.
// Places are in texels of the layer; texel i covers [i, i + 1].

// A rectangle as `summed_area_table_rectangle` makes it: within its region, and at least a texel wide.
struct SummedAreaTableRectangle {
    low: vec2f,
    high: vec2f,
}

// The rectangle around `centre`, cut off at the edges of the region. It is never larger than `largest`, the table's
// largest kernel, and at least one texel wide; at an edge it is moved rather than narrowed below that. Infinite numbers
// count as large ones, a centre that is NaN as the region's corner and a NaN extent as the smallest.
fn summed_area_table_rectangle(region: MapRegion, centre: vec2f, half_extent: vec2f, largest: vec2f) -> SummedAreaTableRectangle {
    let first = vec2f(region.origin);
    let end = first + max(vec2f(region.extent), vec2f(1.0));
    // A compiler may assume that there is no NaN, so it is found by its bits.
    let no_place = (bitcast<vec2u>(centre) & vec2u(0x7fffffffu)) > vec2u(0x7f800000u);
    let no_extent = (bitcast<vec2u>(half_extent) & vec2u(0x7fffffffu)) > vec2u(0x7f800000u);
    let middle = clamp(select(centre, first, no_place), first, end);
    let most = 0.5 * clamp(largest, vec2f(1.0), end - first);
    let reach = clamp(select(half_extent, vec2f(0.5), no_extent), vec2f(0.5), most);
    let low = clamp(middle - reach, first, end - 1.0);
    return SummedAreaTableRectangle(low, clamp(middle + reach, low + 1.0, end));
}

// The sums between the four places `x` along a row of the table: what lies in between, up to this row.
struct SummedAreaTableStrips {
    left: vec4u,
    middle: vec4u,
    right: vec4u,
}

// The strips of a row, with 0 before the first texel of the region.
fn summed_area_table_strips(table: texture_2d_array<u32>, layer: u32, x: vec4i, y: i32, is_first: bool) -> SummedAreaTableStrips {
    let p0 = select(textureLoad(table, vec2i(x.x, y), layer, 0), vec4u(0u), is_first);
    let p1 = textureLoad(table, vec2i(x.y, y), layer, 0);
    let p2 = textureLoad(table, vec2i(x.z, y), layer, 0);
    let p3 = textureLoad(table, vec2i(x.w, y), layer, 0);
    return SummedAreaTableStrips(p1 - p0, p2 - p1, p3 - p2);
}

// The weighted sum of one row of rectangles, out of the strips above and below it.
fn summed_area_table_row(above: SummedAreaTableStrips, below: SummedAreaTableStrips, weight: vec2f) -> vec4f {
    let outer = fma(vec4f(weight.x), vec4f(below.left - above.left), vec4f(below.middle - above.middle));
    return fma(vec4f(weight.y), vec4f(below.right - above.right), outer);
}

// The mean of the channels over a rectangle, in [0, 1]: each texel counts with the part of it that is covered. It equals
// the bilinear interpolation of the table, taken on nine rectangles whose integer sums are exact (Peters et al., JCGT 6(1)
// 2017, section 4); only then it is turned to f32. 16 loads; the error is at most 2^-20.
fn summed_area_table_mean_interpolated(table: texture_2d_array<u32>, layer: u32, region: MapRegion, rectangle: SummedAreaTableRectangle, unit: f32) -> vec4f {
    let first = floor(rectangle.low);
    // At least a texel lies between, so that no sum is negative, even where rounding has narrowed the rectangle.
    let last = max(floor(rectangle.high), first + 1.0);
    let low_part = first + 1.0 - rectangle.low;
    let high_part = saturate(rectangle.high - last);
    let extent = last - first - 1.0 + low_part + high_part;
    let origin = vec2i(region.origin);
    let low = vec2i(first);
    let high = vec2i(last);
    // The texels that end where the strips do. Before the region's first one the sum is 0; behind its last one is none.
    let is_first = low <= origin;
    let before = max(low - 1, origin);
    let after = min(high, origin + vec2i(region.extent) - 1);
    let x = vec4i(before.x, low.x, high.x - 1, after.x);
    let weight_x = vec2f(low_part.x, high_part.x);
    let top = summed_area_table_strips(table, layer, x, before.y, is_first.x);
    let none = vec4<bool>(is_first.y);
    let s0 = SummedAreaTableStrips(select(top.left, vec4u(0u), none), select(top.middle, vec4u(0u), none), select(top.right, vec4u(0u), none));
    let s1 = summed_area_table_strips(table, layer, x, low.y, is_first.x);
    let s2 = summed_area_table_strips(table, layer, x, high.y - 1, is_first.x);
    let s3 = summed_area_table_strips(table, layer, x, after.y, is_first.x);
    let upper = fma(vec4f(low_part.y), summed_area_table_row(s0, s1, weight_x), summed_area_table_row(s1, s2, weight_x));
    let sum = fma(vec4f(high_part.y), summed_area_table_row(s2, s3, weight_x), upper);
    return saturate(sum * (1.0 / (unit * extent.x * extent.y)));
}

// The same for the rectangle whose edges are rounded to whole texels: 4 loads. It jumps where an edge passes the middle
// of a texel, which shows as bands in wide penumbrae.
fn summed_area_table_mean_plain(table: texture_2d_array<u32>, layer: u32, region: MapRegion, rectangle: SummedAreaTableRectangle, unit: f32) -> vec4f {
    let origin = vec2i(region.origin);
    let end = origin + vec2i(region.extent);
    let low = min(vec2i(round(rectangle.low)), end - 1);
    let high = clamp(vec2i(round(rectangle.high)), low + 1, end);
    let is_first = low <= origin;
    let before = max(low - 1, origin);
    let last = high - 1;
    let above_left = select(textureLoad(table, before, layer, 0), vec4u(0u), any(is_first));
    let above = select(textureLoad(table, vec2i(last.x, before.y), layer, 0), vec4u(0u), is_first.y);
    let left = select(textureLoad(table, vec2i(before.x, last.y), layer, 0), vec4u(0u), is_first.x);
    let sum = vec4f(textureLoad(table, last, layer, 0) - left - (above - above_left));
    let extent = vec2f(high - low);
    return saturate(sum * (1.0 / (unit * extent.x * extent.y)));
}
