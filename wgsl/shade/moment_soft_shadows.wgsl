import super::super::shade::area_light::{AreaLight, area_light_box};
import super::super::bounds::hamburger4::{hamburger4_lower_bound};
import super::super::map::map_region::{MapRegion};
import super::super::moments::four_moments::{FourMomentsBias, four_moments_apply_bias, four_moments_dequantize};
import super::super::shade::receiver_bias::{receiver_bias_depth_of_kernel};
import super::super::shade::soft_blockers::{SoftBlockers, soft_blockers_of_four_moments, soft_blockers_of_two_moments};
import super::super::map::storage::{STORAGE_UNORM16};
import super::super::filter::summed_area_table::{SummedAreaTableRectangle, summed_area_table_mean_interpolated, summed_area_table_mean_plain, summed_area_table_rectangle};
import super::super::bounds::chebyshev::{chebyshev_lower_bound};
import super::super::moments::two_moments::{two_moments_from_texel};

// Moment soft shadows: penumbrae of area lights from a summed-area table, in constant time.
//
// As in percentage-closer soft shadows a search finds the blockers of a receiver, their mean depth tells how wide the light
// appears through them, and a filter of that width gives the shadow. Search and filter are one query of the table each, and
// the moments there give mean blocker depth and shadow intensity (Peters et al., JCGT 6(1) 2017, section 5; with two
// moments: Yang et al., "Variance Soft Shadow Mapping", Pacific Graphics 2010). The number of loads is fixed.
//
// One mean depth stands for all blockers: an occluder far from the receiver softens the shadow of one near it.

// Half the width of the box that a lookup between texels averages.
const MOMENT_SOFT_SHADOWS_SMALLEST_EXTENT: f32 = 0.5;

// The table of a map.
struct MomentSoftShadowTable {
    // Its layer, and the region of the light.
    layer: u32,
    region: MapRegion,
    // Width and height of its largest kernel in texels.
    largest_kernel: vec2f,
    // The unit of the sums.
    unit: f32,
    // Whether queries weight texels by the part that they cover, rather than counting whole ones.
    search_interpolated: bool,
    filter_interpolated: bool,
}

// A receiver.
struct MomentSoftShadowReceiver {
    // Its place in texels of the layer.
    place: vec2f,
    // Half the part of the map that a pixel covers, in texels: no filter is smaller.
    footprint: vec2f,
    // Its moment depth, less the rounding error of depths and without any further bias.
    depth: f32,
    // The gradient of moment depth per texel on its plane, and the steepest gradient that does not count as an edge.
    gradient: vec2f,
    steepest: f32,
}

// One query: the means of the table's channels over a rectangle.
fn moment_soft_shadows_mean(sums: texture_2d_array<u32>, table: MomentSoftShadowTable, rectangle: SummedAreaTableRectangle, interpolated: bool) -> vec4f {
    if interpolated {
        return summed_area_table_mean_interpolated(sums, table.layer, table.region, rectangle, table.unit);
    }
    return summed_area_table_mean_plain(sums, table.layer, table.region, rectangle, table.unit);
}

// The rectangle that is filtered for a mean blocker depth; the widest, for -1, the light's near end, is searched for blockers.
fn moment_soft_shadows_rectangle(table: MomentSoftShadowTable, receiver: MomentSoftShadowReceiver, light: AreaLight, blocker_depth: f32) -> SummedAreaTableRectangle {
    let half_extent = max(area_light_box(light, blocker_depth, receiver.depth), receiver.footprint);
    return summed_area_table_rectangle(table.region, receiver.place, half_extent, table.largest_kernel);
}

// The depth that a filter compares with. It lies in front of the receiver by the variation of the receiver's plane within the
// rectangle, so that the bias is as wide as the filter and nothing about it has to be tuned.
fn moment_soft_shadows_fragment_depth(receiver: MomentSoftShadowReceiver, rectangle: SummedAreaTableRectangle) -> f32 {
    let half_extent = 0.5 * (rectangle.high - rectangle.low) + MOMENT_SOFT_SHADOWS_SMALLEST_EXTENT;
    // The standard deviation of a box is its half width over sqrt(3).
    let bias = receiver_bias_depth_of_kernel(receiver.gradient, half_extent * 0.57735027, receiver.steepest);
    return clamp(receiver.depth, -1.0, 1.0) - bias;
}

// The blockers of a receiver, from a table of four moments with its bias.
fn moment_soft_shadows_blockers(sums: texture_2d_array<u32>, table: MomentSoftShadowTable, bias: FourMomentsBias, receiver: MomentSoftShadowReceiver, light: AreaLight) -> SoftBlockers {
    let search = moment_soft_shadows_rectangle(table, receiver, light, -1.0);
    let searched = four_moments_dequantize(moment_soft_shadows_mean(sums, table, search, table.search_interpolated));
    return soft_blockers_of_four_moments(four_moments_apply_bias(searched, bias), receiver.depth, bias.alpha);
}

// The same from a table of two moments with its smallest variance.
fn moment_soft_shadows_variance_blockers(sums: texture_2d_array<u32>, table: MomentSoftShadowTable, smallest_variance: f32, receiver: MomentSoftShadowReceiver, light: AreaLight) -> SoftBlockers {
    let search = moment_soft_shadows_rectangle(table, receiver, light, -1.0);
    let searched = two_moments_from_texel(moment_soft_shadows_mean(sums, table, search, table.search_interpolated), STORAGE_UNORM16).xy;
    return soft_blockers_of_two_moments(searched, receiver.depth, smallest_variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a receiver, from a table of four moments. `bias` is the table's
// (`summed_area_encoding_moment_bias`). 8 loads, or 16 for a query that interpolates in place of 4.
fn moment_soft_shadows_intensity(sums: texture_2d_array<u32>, table: MomentSoftShadowTable, bias: FourMomentsBias, receiver: MomentSoftShadowReceiver, light: AreaLight) -> f32 {
    let blockers = moment_soft_shadows_blockers(sums, table, bias, receiver, light);
    let rectangle = moment_soft_shadows_rectangle(table, receiver, light, blockers.depth);
    let filtered = four_moments_dequantize(moment_soft_shadows_mean(sums, table, rectangle, table.filter_interpolated));
    let depth = moment_soft_shadows_fragment_depth(receiver, rectangle);
    return hamburger4_lower_bound(four_moments_apply_bias(filtered, bias), depth, bias.alpha);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a receiver, from a table of two moments. `smallest_variance` is the table's
// (`summed_area_encoding_smallest_variance`). The loads are those of `moment_soft_shadows_intensity`.
fn moment_soft_shadows_variance_intensity(sums: texture_2d_array<u32>, table: MomentSoftShadowTable, smallest_variance: f32, receiver: MomentSoftShadowReceiver, light: AreaLight) -> f32 {
    let blockers = moment_soft_shadows_variance_blockers(sums, table, smallest_variance, receiver, light);
    let rectangle = moment_soft_shadows_rectangle(table, receiver, light, blockers.depth);
    let filtered = two_moments_from_texel(moment_soft_shadows_mean(sums, table, rectangle, table.filter_interpolated), STORAGE_UNORM16).xy;
    return chebyshev_lower_bound(filtered, moment_soft_shadows_fragment_depth(receiver, rectangle), smallest_variance);
}
