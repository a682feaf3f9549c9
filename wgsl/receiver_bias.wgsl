// Receiver bias: how far the fragment depth moves towards the light so that a surface does not shadow itself.
//
// Not to be confused with the moment bias, which belongs to storage. A plane tilted against the light fills the filter
// kernel with depths whose standard deviation is
//   (the kernel's standard deviation in texels) x (change of depth per texel).
// The lower bound of four moments is exactly 0 for fragments in front of the lower Gauss node, which for a symmetric
// distribution lies one standard deviation in front of the mean. So a slope-scaled bias of somewhat more than one
// standard deviation removes self-shadowing on planes, and nothing about it has to be tuned to a scene.

// Filled by the host-side `ReceiverBias`.
struct ReceiverBias {
    // Moment depth that is always subtracted.
    constant: f32,
    // Multiplies the length of the gradient of moment depth per texel: the kernel's standard deviation in texels, times
    // a safety factor slightly above 1.
    slope_scale: f32,
    // The largest bias in moment depth; reached where the surface is seen edge-on by the light.
    maximum: f32,
    // Scene units by which a receiver moves along its normal at grazing light; 0 where only depth is biased.
    normal_offset: f32,
}

// Length of the gradient of moment depth per texel on the receiver's plane, from the differences of two neighbouring
// points on it in light space: xy in texels of the map, z in moment depth, each at most 1e9. Where the differences in xy
// are parallel or zero (the plane is edge-on to the light, or a neighbour is missing) the result is huge, and
// `receiver_bias_depth` limits it.
fn receiver_bias_gradient(difference_x: vec3f, difference_y: vec3f) -> f32 {
    let determinant = difference_x.x * difference_y.y - difference_x.y * difference_y.x;
    if abs(determinant) < 1e-20 {
        return 1e20;
    }
    // Cramer's rule for the gradient g in dot(g, difference.xy) = difference.z.
    let scaled = vec2f(
        difference_x.z * difference_y.y - difference_y.z * difference_x.y,
        difference_y.z * difference_x.x - difference_x.z * difference_y.x,
    );
    return length(scaled) / abs(determinant);
}

// The same from the cosine between surface normal and direction to the light: `depth_per_texel` is the moment depth
// of one texel's width, along the light's axis.
fn receiver_bias_gradient_from_cosine(cosine: f32, depth_per_texel: f32) -> f32 {
    let c = clamp(cosine, 0.0, 1.0);
    let sine = sqrt(max(1.0 - c * c, 0.0));
    return depth_per_texel * sine / max(c, 1e-6);
}

// The receiver bias in moment depth, to be subtracted from the fragment depth.
fn receiver_bias_depth(bias: ReceiverBias, gradient: f32) -> f32 {
    return clamp(fma(bias.slope_scale, gradient, bias.constant), 0.0, bias.maximum);
}

// The position, in scene units, at which to look the map up when the receiver moves along its normal: the offset
// grows with the sine of the angle between normal and light (`cosine` > 0 faces the light).
fn receiver_bias_offset_position(bias: ReceiverBias, position: vec3f, normal: vec3f, cosine: f32) -> vec3f {
    let c = clamp(cosine, -1.0, 1.0);
    return fma(vec3f(bias.normal_offset * sqrt(max(1.0 - c * c, 0.0))), normal, position);
}
