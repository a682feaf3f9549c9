// Reduction of light leaking after the bound: it leaves the moments alone.
//
// Multiplying the moments by a constant before solving ("moment scale" in some samples) is not offered: it makes the
// total weight differ from one, so that the result bounds nothing.

// Filled by the host-side `LeakReduction`.
struct LeakReduction {
    // Shadow intensity that counts as full shadow, in (0, 1]; 0.98 hides weak leaks (Peters, GDC 2016).
    full_shadow: f32,
    // Visibility that counts as zero, in [0, 1) (light bleeding reduction; Lauritzen, thesis 2008, section 3.4).
    bleed_reduction: f32,
    // Exponent of visibility, > 0; above 1 darkens penumbrae.
    visibility_exponent: f32,
    padding: f32,
}

// Shadow intensity after division by `full_shadow`.
fn leak_reduction_full_shadow(shadow_intensity: f32, full_shadow: f32) -> f32 {
    return saturate(shadow_intensity / max(full_shadow, 1e-6));
}

// An intensity below this is what rounding leaves of 0: half a unit in the last place of full light.
const LEAK_REDUCTION_LEAST_SHADOW: f32 = 5.9604645e-8;

// Shadow intensity in [0, 1] after all three reductions. Each only darkens; full light stays full light.
fn leak_reduction_apply(shadow_intensity: f32, reduction: LeakReduction) -> f32 {
    // What is left of the visibility v = 1 - s / f is (v - b) / (1 - b) = 1 - s / (f (1 - b)): both divide alike.
    let full_shadow = fma(-reduction.full_shadow, reduction.bleed_reduction, reduction.full_shadow);
    let shadow = leak_reduction_full_shadow(shadow_intensity, full_shadow);
    // An exponent of 1 is to change nothing at all, and costs nothing: it is the same for all pixels of a view.
    if reduction.visibility_exponent == 1.0 {
        return select(shadow, 0.0, shadow < LEAK_REDUCTION_LEAST_SHADOW);
    }
    // A power goes through the logarithm, of 0 too.
    let curved = pow(max(1.0 - shadow, 1e-30), max(reduction.visibility_exponent, 1e-6));
    return select(1.0 - curved, 1.0, shadow >= 1.0);
}
