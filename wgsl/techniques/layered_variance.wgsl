import super::super::map::depth::{depth_of_fragment};
import super::super::bounds::chebyshev::{chebyshev_lower_bound};
import super::super::moments::two_moments::{two_moments_from_texel, two_moments_smallest_variance_of};

// Layered variance shadow mapping: variance shadow mapping of several ranges of depth.
//
// Layer [p, q] warps depth by t -> clamp((t - p) / (q - p), 0, 1) before its two moments are taken, so that occluders in
// front of it all coincide: light bleeds only between occluders within the layer that contains the fragment (Lauritzen &
// McCool, "Layered Variance Shadow Maps", GI 2008, section 4; Lauritzen, thesis 2008, section 4.1). The warp here goes to
// [-1, 1] instead of [0, 1], so that encoding and smallest variance are those of `two_moments` and the bound that of
// `chebyshev`; one layer equals variance shadow mapping to the bit. A texel holds two layers, so n of them take (n + 1) / 2
// planes.

// The largest number of layers.
const LAYERED_VARIANCE_LARGEST_COUNT: u32 = 8u;

// The smallest width of a layer.
const LAYERED_VARIANCE_SMALLEST_HALF_WIDTH: f32 = 1e-4;

// The layers, front to back.
struct LayeredVarianceLayers {
    // The splits behind layers 0 to count - 2, ascending in [-1, 1]; four to a vector. What follows them is not read.
    splits: array<vec4f, 2>,
    // From 1 to 8.
    count: u32,
    // Both layers at a split reach this far beyond it.
    overlap: f32,
    padding: vec2f,
}

// The split behind a layer.
fn layered_variance_split(layers: LayeredVarianceLayers, layer: u32) -> f32 {
    var splits = layers.splits;
    let index = min(layer, LAYERED_VARIANCE_LARGEST_COUNT - 1u);
    return clamp(splits[index / 4u][index % 4u], -1.0, 1.0);
}

// The number of layers, from 1 to 8.
fn layered_variance_count(layers: LayeredVarianceLayers) -> u32 {
    return clamp(layers.count, 1u, LAYERED_VARIANCE_LARGEST_COUNT);
}

// The interval [p, q] of a layer with its overlaps; the first begins at -1, the last ends at 1. Indices beyond the last
// count as the last, which fills the second half of the last texel of an odd number of layers.
fn layered_variance_interval(layers: LayeredVarianceLayers, layer: u32) -> vec2f {
    let last = layered_variance_count(layers) - 1u;
    let index = min(layer, last);
    var interval = vec2f(-1.0, 1.0);
    if index > 0u {
        interval.x = max(layered_variance_split(layers, index - 1u) - layers.overlap, -1.0);
    }
    if index < last {
        interval.y = min(layered_variance_split(layers, index) + layers.overlap, 1.0);
    }
    return interval;
}

// Depth as a layer sees it: -1 at its front and before, 1 at its back and beyond. The identity for [-1, 1].
fn layered_variance_warp(z: f32, interval: vec2f) -> f32 {
    let half_width = max(0.5 * (interval.y - interval.x), LAYERED_VARIANCE_SMALLEST_HALF_WIDTH);
    return clamp((z - 0.5 * (interval.x + interval.y)) / half_width, -1.0, 1.0);
}

// The channels to average for a depth z in [-1, 1] in a plane, which holds the layers 2 * plane and 2 * plane + 1; to be
// written with `two_moments_to_texel`.
fn layered_variance_channels(z: f32, layers: LayeredVarianceLayers, plane: u32) -> vec4f {
    let near = layered_variance_warp(z, layered_variance_interval(layers, 2u * plane));
    let far = layered_variance_warp(z, layered_variance_interval(layers, 2u * plane + 1u));
    return vec4f(near, near * near, far, far * far);
}

// The last layer that begins in front of a fragment. Each layer gives a lower bound, and those behind it the bound 0.
fn layered_variance_last_layer(layers: LayeredVarianceLayers, fragment_depth: f32) -> u32 {
    let depth = depth_of_fragment(fragment_depth);
    let last = layered_variance_count(layers) - 1u;
    var layer = 0u;
    while layer < last && layered_variance_split(layers, layer) - layers.overlap < depth {
        layer++;
    }
    return layer;
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment by one layer, for the filtered texel of the plane `layer / 2`: a
// lower bound. Fragments outside the layer count as its ends.
fn layered_variance_shadow_intensity_of_texel(
    texel: vec4f,
    fragment_depth: f32,
    stored_as: u32,
    layers: LayeredVarianceLayers,
    layer: u32,
) -> f32 {
    let pairs = two_moments_from_texel(texel, stored_as);
    let moments = select(pairs.xy, pairs.zw, layer % 2u == 1u);
    let warped = layered_variance_warp(depth_of_fragment(fragment_depth), layered_variance_interval(layers, layer));
    return chebyshev_lower_bound(moments, warped, two_moments_smallest_variance_of(stored_as));
}

// The same by the darker of the two layers of a plane. The darkest of all planes up to that of `layered_variance_last_layer` is
// the bound to show. Just behind a split the layer that contains a fragment hardly tells it from what is in front, of which the
// layer before knows that all of it lies in front; that one in turn knows nothing of occluders before itself.
fn layered_variance_shadow_intensity_of_plane(
    texel: vec4f,
    fragment_depth: f32,
    stored_as: u32,
    layers: LayeredVarianceLayers,
    plane: u32,
) -> f32 {
    return max(
        layered_variance_shadow_intensity_of_texel(texel, fragment_depth, stored_as, layers, 2u * plane),
        layered_variance_shadow_intensity_of_texel(texel, fragment_depth, stored_as, layers, 2u * plane + 1u),
    );
}
