// Gaussian filter weights.
//
// Filters of moments need weights that are not negative and sum to one; the Gaussian, cut off at a radius and normalised, is
// the one that the moment shadow mapping papers use (9 x 9 texels with sigma 2.4; i3D 2015, section 4). The module `separable`
// filters with them.

// Gaussian at `offset` texels from the centre, not normalised. `sigma` > 0 in texels; smaller values count as 1e-3.
fn gaussian_weight(offset: f32, sigma: f32) -> f32 {
    let ratio = offset / max(sigma, 1e-3);
    return exp(-0.5 * ratio * ratio);
}
