// Gaussian filter weights, and the plain form of the separable filter.
//
// Filters of moments need weights that are not negative and sum to one; the Gaussian, cut off at a radius and normalised, is
// the one that the moment shadow mapping papers use (9 x 9 texels with sigma 2.4; i3D 2015, section 4). Render-graph nodes
// filter with blocks of texels held in registers; the form here is for other shaders, and the nodes are compared with it.

// Gaussian at `offset` texels from the centre, not normalised. `sigma` > 0 in texels; smaller values count as 1e-3.
fn gaussian_weight(offset: f32, sigma: f32) -> f32 {
    let ratio = offset / max(sigma, 1e-3);
    return exp(-0.5 * ratio * ratio);
}

// One direction of the separable filter at `texel`: 2 radius + 1 texels of mip 0 along `direction` ((1, 0) or (0, 1)),
// weighted and normalised. Beyond the border the last texel repeats. `radius` from 0 to 64.
fn gaussian_filter(map: texture_2d<f32>, texel: vec2i, direction: vec2i, radius: i32, sigma: f32) -> vec4f {
    let last = vec2i(textureDimensions(map)) - 1;
    let reach = clamp(radius, 0, 64);
    var sum = vec4f(0.0);
    var total = 0.0;
    for (var offset = -reach; offset <= reach; offset++) {
        let weight = gaussian_weight(f32(offset), sigma);
        sum = fma(vec4f(weight), textureLoad(map, clamp(texel + offset * direction, vec2i(0), last), 0), sum);
        total += weight;
    }
    // The centre's weight is 1, so the total is at least 1.
    return sum / total;
}
