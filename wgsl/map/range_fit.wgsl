// The range that fits itself: moment depths of a host's range, spread over the part of it that casters take.
//
// What a moment bias leaks is a share of the range, so that a range that is ten times too long leaks ten times as far. The node
// `fit_range` finds the casters of each region on the device. What goes into a map and what is compared with it are moved alike,
// by the functions below. Receivers behind all casters then lie at the far end, as texels without a caster do: still behind
// every caster, since the range goes on a little behind the last one.

// Where the range of a region lies in the host's.
struct RangeFit {
    // The moment depth of its middle.
    middle: f32,
    // How many times the host's range is as long; at least 1.
    scale: f32,
}

// The host's range itself.
fn range_fit_none() -> RangeFit {
    return RangeFit(0.0, 1.0);
}

// The fit in a texel of the node's output: middle and scale. Zeros, as before the first frame, are the host's range.
fn range_fit_of_texel(texel: vec4f) -> RangeFit {
    return RangeFit(texel.x, max(texel.y, 1.0));
}

// The fit of the region of a layer whose first texel is `origin`: `ranges` is the node's output, which has a texel per region with
// that place in z and w. The host's range where there is no such region.
fn range_fit_load(ranges: texture_2d_array<f32>, layer: u32, origin: vec2u) -> RangeFit {
    let regions = textureDimensions(ranges).x;
    for (var number = 0u; number < regions; number++) {
        let texel = textureLoad(ranges, vec2u(number, 0u), layer, 0);
        if all(texel.zw == vec2f(origin)) {
            return range_fit_of_texel(texel);
        }
    }
    return range_fit_none();
}

// A moment depth of the host's range in the fitted one, not clamped. Differences and gradients of moment depth grow by `scale`.
fn range_fit_depth(fit: RangeFit, z: f32) -> f32 {
    // The difference comes first: near the middle it has no rounding error, which the scale would enlarge.
    return (z - fit.middle) * fit.scale;
}

// The moment depth in [-1, 1] that a map holds of what lies at moment depth `z` of the host's range.
fn range_fit_map_depth(fit: RangeFit, z: f32) -> f32 {
    return clamp(range_fit_depth(fit, z), -1.0, 1.0);
}
