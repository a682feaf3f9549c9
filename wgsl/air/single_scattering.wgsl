import super::super::air::phase_function::{phase_function_henyey_greenstein};

// Light of a directional source that a homogeneous medium scatters once, along a view ray.
//
// Without shadows the radiance of each colour is a closed form of the ray's length. Shadows enter as one number: the share of
// the ray's transmittance-weighted length that is shadowed, which prefix sums of moments in rectified coordinates bound for
// one lookup per pixel (Peters et al., JCGT 6(1) 2017, section 7).

const SINGLE_SCATTERING_LOG2_E: f32 = 1.4426950408889634;

// Filled by the host-side `SingleScattering`. All values are finite and at least 0, except the anisotropy, which is in [-1,
// 1].
struct SingleScattering {
    // Extinction per scene unit, by colour.
    extinction: vec3f,
    // The anisotropy of Henyey and Greenstein's phase function; 0 is isotropic, forwards is positive.
    anisotropy: f32,
    // Scattering per scene unit, by colour.
    scattering: vec3f,
    // The extinction that shadows are weighted with, the same for all colours.
    mean_extinction: f32,
    // Irradiance of a surface that faces the light.
    irradiance: vec3f,
    padding: f32,
}

// (1 - exp2(-x)) / x for x >= 0; log(2) at 0.
fn single_scattering_mean_of_halves(x: vec3f) -> vec3f {
    // Where the difference would cancel: a polynomial, off by less than 2^-24.
    var series = fma(x, vec3f(0.00113401694), vec3f(-0.00952348722));
    series = fma(x, series, vec3f(0.0554860587));
    series = fma(x, series, vec3f(-0.240225424));
    series = fma(x, series, vec3f(0.6931471805599453));
    let direct = (1.0 - exp2(-x)) / max(x, vec3f(0.25));
    return select(direct, series, x < vec3f(0.577));
}

// (1 - exp(-x)) / x for x >= 0; 1 at 0. The mean transmittance of a stretch of optical thickness x.
fn single_scattering_mean_transmittance(x: vec3f) -> vec3f {
    return SINGLE_SCATTERING_LOG2_E * single_scattering_mean_of_halves(SINGLE_SCATTERING_LOG2_E * x);
}

// The largest radiance of a pixel: what float16 holds.
const SINGLE_SCATTERING_LARGEST: f32 = 65504.0;

// What a view ray of some length takes from its medium.
struct SingleScatteringRay {
    // Radiance that is scattered into it.
    radiance: vec3f,
    // The share that is left of the light behind it, by colour: 1 to the bit where nothing is extinguished.
    transmittance: vec3f,
}

// A view ray of which a part is shadowed. `cosine` is the cosine of the angle between the directions of the light and the
// view ray, which lead away from light and camera.
fn single_scattering_ray(medium: SingleScattering, distance: f32, cosine: f32, shadow: f32) -> SingleScatteringRay {
    // Light that reaches the camera has turned from the light's direction to the reverse of the view ray's.
    let phase = phase_function_henyey_greenstein(-cosine, medium.anisotropy);
    // By how many factors of one half light is attenuated.
    let length = SINGLE_SCATTERING_LOG2_E * distance;
    let halves = medium.extinction * length;
    let mean = single_scattering_mean_of_halves(max(halves, vec3f(0.0)));
    let lit = phase * (1.0 - shadow) * length;
    // A medium of no number has no transmittance either, whatever the maximum is.
    return SingleScatteringRay(lit * medium.irradiance * medium.scattering * mean, fma(-halves, mean, vec3f(1.0)));
}

// The output of a pixel: radiance, and the mean of the colours' transmittance, which is 1 to the bit where all of them are.
// If one of them is non-finite because a parameter is invalid, there is no medium. Negative light counts as 0.
fn single_scattering_pixel(ray: SingleScatteringRay) -> vec4f {
    let transmittance = ray.transmittance;
    let others = (transmittance.y - transmittance.x) + (transmittance.z - transmittance.x);
    let pixel = vec4f(ray.radiance, fma(others, 1.0 / 3.0, transmittance.x));
    // By the bits of a sum that does not overflow: a compiler may assume that neither NaN nor infinity occurs.
    let sum = dot(pixel, vec4f(0.25));
    let impossible = (bitcast<u32>(sum) & 0x7f800000u) == 0x7f800000u;
    let lit = clamp(pixel.xyz, vec3f(0.0), vec3f(SINGLE_SCATTERING_LARGEST));
    return select(vec4f(lit, saturate(pixel.w)), vec4f(0.0, 0.0, 0.0, 1.0), impossible);
}

// How far occluders are moved away from the light before view rays are compared with them, as a part of what then lies in front.
const SINGLE_SCATTERING_DEPTH_BIAS: f32 = 0.05;

// The rectified depth in [-1, 1] of an occluder where it is not known which view rays pass it. A lit surface at which a view ray ends is
// an occluder just behind it, ever nearer towards the ray's end. Moments cannot tell it from an occluder just before the ray, so
// the air above lit ground would be too dark. Occluders at -1 stay in front of all view rays. The bias is fitted: with a larger one
// light leaks behind casters near the ray; without any, 16 steps of marching are better where little of what is seen is in
// shadow.
fn single_scattering_occluder_depth(depth: f32) -> f32 {
    return min(fma(1.0 / (1.0 - SINGLE_SCATTERING_DEPTH_BIAS), depth + 1.0, -1.0), 1.0);
}

// The shadow to show, between its bounds (x <= y): overestimation that adapts to the direction. Where a view ray runs with
// the light, it leans to the lower bound, whose error is light that leaks into shadow; where it runs against the light, to
// the upper bound, whose error is darkness (GDC 2016, where the weight of the lower bound is beta; the supplement of i3D 2016
// calls its complement beta). Both sources go all the way; here `overestimation` says how strongly, x against the light and y
// with it, each in [0, 1]. With 0 it is the middle of the bounds, which is too dark looking away from the light.
fn single_scattering_shadow(bounds: vec2f, cosine: f32, overestimation: vec2f) -> f32 {
    let strength = select(overestimation.x, overestimation.y, cosine > 0.0);
    // Not `mix`, which need not be 1 between bounds of 1.
    return fma(saturate(fma(0.5 * strength, cosine, 0.5)), bounds.x - bounds.y, bounds.y);
}
