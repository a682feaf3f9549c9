import super::super::air::single_scattering::{single_scattering_mean_transmittance};

// Fog whose density falls exponentially with height (Wenzel, "Real-time atmospheric effects in games", SIGGRAPH 2006), as a
// factor of a medium's extinction and scattering.
//
// Its optical thickness along a ray is a closed form, for rays that rise, fall or are level, and for those that begin far
// above the fog or deep in it. Air of one density is fog without a gradient.

// Filled by the host-side `HeightFogView`. Positions are relative to the camera.
struct HeightFog {
    // By how much the logarithm of the density falls, per scene unit along each axis.
    gradient: vec3f,
    // That logarithm at the camera. A logarithm, so that fog far below the camera has a density, too.
    log_density: f32,
}

// Logarithms of density beyond these count as these: nothing to be seen, and nothing to be seen through. With the limits of
// single scattering's parameters all products stay finite.
const HEIGHT_FOG_THINNEST: f32 = -80.0;
const HEIGHT_FOG_DENSEST: f32 = 40.0;

// The largest optical thickness per extinction.
const HEIGHT_FOG_THICKEST: f32 = 1e18;

// The value, or 0 where it is negative or no finite number. By its bits: a compiler may assume that neither NaN nor infinity
// occurs.
fn height_fog_valid(value: f32) -> f32 {
    return select(0.0, value, bitcast<u32>(value) < 0x7f800000u);
}

// The optical thickness per extinction of a stretch of a ray: the mean density times the length, which is not negative. 0 for
// fog of no number.
fn height_fog_thickness(fog: HeightFog, start: vec3f, direction: vec3f, length: f32) -> f32 {
    let first = fog.log_density - dot(fog.gradient, start);
    let fall = dot(fog.gradient, direction) * length;
    // From the denser end on the density falls, so that nothing overflows: its mean is (1 - exp(-|fall|)) / |fall| of that.
    let densest = clamp(max(first, first - fall), HEIGHT_FOG_THINNEST, HEIGHT_FOG_DENSEST);
    let mean = exp(densest) * single_scattering_mean_transmittance(vec3f(abs(fall))).x;
    let known = (bitcast<u32>(first - fall) & 0x7f800000u) != 0x7f800000u;
    return select(0.0, min(height_fog_valid(mean * length), HEIGHT_FOG_THICKEST), known);
}
