import super::super::map::map_region::{MapRegion};

// Summed-area tables: the mean over any rectangle of a map, at a cost that does not depend on its size.
//
// A texel of the table is the sum of all texels of its region that lie neither below it nor to its right (Crow, SIGGRAPH
// 1984). Sums are integers modulo 2^32: they wrap around, but the sum over a rectangle is right as long as it is below 2^32
// (Hensley et al., Eurographics 2005). Channels are those of the storage unorm16, in [0, 1] times a `unit`. Places are in
// texels of the layer; texel i covers [i, i + 1].

// A rectangle as `summed_area_table_rectangle` makes it: within its region, and at least a texel wide.
struct SummedAreaTableRectangle {
    low: vec2f,
    high: vec2f,
}

// The rectangle around `centre`, cut off at the edges of the region, which has at least one texel. It is never larger than
// `largest`, the table's largest kernel, finite and at least 1, and at least one texel wide; at an edge it is moved rather than
// narrowed below that. A centre may be infinite, as may an extent; a centre that is NaN counts as the region's corner and
// an extent that is NaN as the smallest.
fn summed_area_table_rectangle(region: MapRegion, centre: vec2f, half_extent: vec2f, largest: vec2f) -> SummedAreaTableRectangle {
    let first = vec2f(region.origin);
    let end = vec2f(region.origin + region.extent);
    // A compiler may assume that no NaN occurs, so NaN is found by its bits.
    let no_place = (bitcast<vec2u>(centre) & vec2u(0x7fffffffu)) > vec2u(0x7f800000u);
    let no_extent = (bitcast<vec2u>(half_extent) & vec2u(0x7fffffffu)) > vec2u(0x7f800000u);
    let middle = select(centre, first, no_place);
    let reach = max(min(select(half_extent, vec2f(0.5), no_extent), 0.5 * largest), vec2f(0.5));
    let low = clamp(middle - reach, first, end - 1.0);
    return SummedAreaTableRectangle(low, clamp(middle + reach, low + 1.0, end));
}

// The four corners of a rectangle of whole texels, and what they are in the table. Before the region's first row or column
// the sum is 0, but no texel holds that 0, and to replace what was loaded would take a selection per channel. Instead all
// corners on a missing row (or column) are the one texel `nowhere`, so that they cancel each other out in the sum p11 - p10 -
// p01 + p00. Where both are missing it is subtracted twice; `twice` makes up for that.
struct SummedAreaTableOrigin {
    // The texel before the rectangle's first, as far as there is one.
    nowhere: vec2i,
    // Whether there is no column (x) or no row (y) before the rectangle.
    is_missing: vec2<bool>,
    // 1 where both are missing, otherwise 0: by how much the first corner is shifted left.
    twice: u32,
}

// The origin of a rectangle that begins with the texel `low`.
fn summed_area_table_origin(region: MapRegion, low: vec2i) -> SummedAreaTableOrigin {
    let origin = vec2i(region.origin);
    let is_missing = low <= origin;
    return SummedAreaTableOrigin(max(low - 1, origin), is_missing, select(0u, 1u, all(is_missing)));
}

// Differences along a row of the table at four places: the sums of three strips, from the region's first row to this one.
struct SummedAreaTableStrips {
    left: vec4u,
    middle: vec4u,
    right: vec4u,
}

// The strips between the texel `before` and those at `x` in a row.
fn summed_area_table_strips(table: texture_2d_array<u32>, layer: u32, before: vec4u, x: vec3i, y: i32) -> SummedAreaTableStrips {
    let p1 = textureLoad(table, vec2i(x.x, y), layer, 0);
    let p2 = textureLoad(table, vec2i(x.y, y), layer, 0);
    let p3 = textureLoad(table, vec2i(x.z, y), layer, 0);
    return SummedAreaTableStrips(p1 - before, p2 - p1, p3 - p2);
}

// The weighted sum of three rectangles, out of the strips above and below them.
fn summed_area_table_row(above: SummedAreaTableStrips, below: SummedAreaTableStrips, weight: vec2f) -> vec4f {
    let outer = fma(vec4f(weight.x), vec4f(below.left - above.left), vec4f(below.middle - above.middle));
    return fma(vec4f(weight.y), vec4f(below.right - above.right), outer);
}

// The mean of the channels over a rectangle, in [0, 1]: each texel counts with the part of it that is covered. It equals
// the bilinear interpolation of the table, taken on nine rectangles whose integer sums are exact (Peters et al., JCGT 6(1)
// 2017, section 4); only then it is turned to f32. 16 loads; the error is at most 2^-20.
fn summed_area_table_mean_interpolated(table: texture_2d_array<u32>, layer: u32, region: MapRegion, rectangle: SummedAreaTableRectangle, unit: f32) -> vec4f {
    let first = floor(rectangle.low);
    // At least 1 more than `first`, so that no sum is negative: that holds for the sum of `low` and 1 in f32, too.
    let last = floor(rectangle.high);
    let low_part = 1.0 - (rectangle.low - first);
    let high_part = rectangle.high - last;
    let extent = rectangle.high - rectangle.low;
    // The texels that end where the strips do; none lies behind the region's last one.
    let low = vec2i(first);
    let high = vec2i(last);
    let after = min(high, vec2i(region.origin + region.extent) - 1);
    let before = summed_area_table_origin(region, low);
    let x = vec3i(low.x, high.x - 1, after.x);
    let y = vec3i(low.y, high.y - 1, after.y);
    let top_x = select(x, vec3i(before.nowhere.x), vec3<bool>(before.is_missing.y));
    let left_y = select(y, vec3i(before.nowhere.y), vec3<bool>(before.is_missing.x));
    let corner = textureLoad(table, before.nowhere, layer, 0) << vec4u(before.twice);
    let s0 = summed_area_table_strips(table, layer, corner, top_x, before.nowhere.y);
    let s1 = summed_area_table_strips(table, layer, textureLoad(table, vec2i(before.nowhere.x, left_y.x), layer, 0), x, y.x);
    let s2 = summed_area_table_strips(table, layer, textureLoad(table, vec2i(before.nowhere.x, left_y.y), layer, 0), x, y.y);
    let s3 = summed_area_table_strips(table, layer, textureLoad(table, vec2i(before.nowhere.x, left_y.z), layer, 0), x, y.z);
    let weight = vec2f(low_part.x, high_part.x);
    let upper = fma(vec4f(low_part.y), summed_area_table_row(s0, s1, weight), summed_area_table_row(s1, s2, weight));
    let sum = fma(vec4f(high_part.y), summed_area_table_row(s2, s3, weight), upper);
    return saturate(sum * (1.0 / (unit * extent.x * extent.y)));
}

// The mean of the channels, in [0, 1], over the rectangle whose edges are rounded to whole texels: 4 loads. It jumps where an
// edge passes the middle of a texel, which shows as bands in wide penumbrae.
fn summed_area_table_mean_plain(table: texture_2d_array<u32>, layer: u32, region: MapRegion, rectangle: SummedAreaTableRectangle, unit: f32) -> vec4f {
    let low = round(rectangle.low);
    // Where both edges are halfway between texels they may be rounded to the same.
    let high = max(round(rectangle.high), low + 1.0);
    // The region's last texel stays in.
    let beyond = max(high - vec2f(region.origin + region.extent), vec2f(0.0));
    let before = summed_area_table_origin(region, vec2i(low - beyond));
    let last = vec2i(high - beyond) - 1;
    let above = select(vec2i(last.x, before.nowhere.y), before.nowhere, before.is_missing.y);
    let left = select(vec2i(before.nowhere.x, last.y), before.nowhere, before.is_missing.x);
    let corner = textureLoad(table, before.nowhere, layer, 0) << vec4u(before.twice);
    let sum = textureLoad(table, last, layer, 0) - textureLoad(table, left, layer, 0) - textureLoad(table, above, layer, 0) + corner;
    let extent = high - low;
    return saturate(vec4f(sum) * (1.0 / (unit * extent.x * extent.y)));
}
