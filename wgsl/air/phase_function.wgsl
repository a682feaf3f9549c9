// Phase functions: the part of a medium's scattered light that goes on in a direction, per steradian.
//
// `cosine` is the cosine of the angle between the light's directions before and after. Each function integrates to 1 over the
// sphere.

// The isotropic phase function: 1 / (4 pi) in all directions.
const PHASE_FUNCTION_ISOTROPIC: f32 = 0.07957747;

// The strongest anisotropy: f32 still resolves its lobe.
const PHASE_FUNCTION_LARGEST_ANISOTROPY: f32 = 0.99;

// The phase function of Henyey & Greenstein ("Diffuse radiation in the galaxy", 1941): forwards for anisotropies above 0,
// backwards below, and isotropic to the bit at 0. `cosine` is in [-1, 1].
fn phase_function_henyey_greenstein(cosine: f32, anisotropy: f32) -> f32 {
    let g = clamp(anisotropy, -PHASE_FUNCTION_LARGEST_ANISOTROPY, PHASE_FUNCTION_LARGEST_ANISOTROPY);
    // (1 - |g|)^2 + 2 (|g| - g cosine): the last difference is rounded once, so nothing cancels.
    let nearest = 1.0 - abs(g);
    let square = fma(2.0, max(fma(-g, cosine, abs(g)), 0.0), nearest * nearest);
    return PHASE_FUNCTION_ISOTROPIC * (1.0 - g * g) / (square * sqrt(square));
}
