import super::super::maths::angle::{angle_sin_cos};
import super::super::map::depth::{depth_of_fragment};
import super::super::map::storage::{STORAGE_FLOAT16, storage_finite_texel, storage_is_float, storage_round_to_float16};

// Convolution shadow mapping: the binary test as a Fourier series of depth.
//
// With d the receiver and z the occluder, both in [0, 1], and c_k = pi (2 k - 1), the test z < d is
//   1/2 + 2 sum_k (sin(c_k d) cos(c_k z) - cos(c_k d) sin(c_k z)) / c_k
// (Annen et al., "Convolution Shadow Maps", EGSR 2007, section 4). The factors that depend on z are what is filtered: a
// texel holds sine and cosine of two terms, so M terms take (M + 1) / 2 planes. Damping the terms by exp(-a (k / M)^2)
// suppresses the ringing of the truncated series.
//
// That series f(d - z) is a step with a ramp around 0 and ripples beside it, and periodic: it falls again towards d - z = 1.
// The plain series is an estimate. For a lower bound the receiver moves towards the light by the ramp's half width and the
// largest ripple is subtracted; the bound is not sharp, and full shadow comes out a little below 1.

// The largest number of terms.
const CONVOLUTION_LARGEST_TERMS: u32 = 16u;

// The damping a that the lower bound is made for.
const CONVOLUTION_DAMPING: f32 = 1.0;

// For M = 1 to 16 terms: a shift x and an overshoot y so that f(t) <= y for t from x - 1 to -x, and f <= 1 + y everywhere.
// Found numerically, rounded up; a shorter shift would make the overshoot grow faster than it saves.
const CONVOLUTION_BOUNDS: array<vec2f, 16> = array<vec2f, 16>(
    vec2f(0.2622, 0.3282),
    vec2f(0.2599, 0.0889),
    vec2f(0.1771, 0.0473),
    vec2f(0.1278, 0.0354),
    vec2f(0.0997, 0.0298),
    vec2f(0.0815, 0.0265),
    vec2f(0.0689, 0.0245),
    vec2f(0.0596, 0.0231),
    vec2f(0.0526, 0.0221),
    vec2f(0.0470, 0.0213),
    vec2f(0.0426, 0.0207),
    vec2f(0.0388, 0.0202),
    vec2f(0.0357, 0.0199),
    vec2f(0.0330, 0.0195),
    vec2f(0.0307, 0.0193),
    vec2f(0.0287, 0.0191),
);

// The number of terms, from 1 to 16.
fn convolution_terms(terms: u32) -> u32 {
    return clamp(terms, 1u, CONVOLUTION_LARGEST_TERMS);
}

// Shift and overshoot for a number of terms.
fn convolution_bound(terms: u32) -> vec2f {
    var bounds = CONVOLUTION_BOUNDS;
    return bounds[convolution_terms(terms) - 1u];
}

// The place of a depth z in [-1, 1] on the axis of the series. It ends two shifts before 1, so that the periodic series is
// never evaluated where it turns, with or without the lower bound.
fn convolution_place(z: f32, terms: u32) -> f32 {
    return fma(0.5, z, 0.5) * (1.0 - 2.0 * convolution_bound(terms).x);
}

// Sine and cosine of c_k times a place in [-1, 1] for the two terms of a plane, k = 2 * plane + 1 and 2 * plane + 2.
fn convolution_waves(place: f32, plane: u32) -> vec4f {
    // In half turns, less whole turns.
    let half_turns = vec2f(4.0 * f32(plane) + 1.0, 4.0 * f32(plane) + 3.0) * place;
    let angles = 3.141592653589793 * (half_turns - 2.0 * round(0.5 * half_turns));
    return vec4f(angle_sin_cos(angles.x), angle_sin_cos(angles.y));
}

// The channels to average for a depth z in [-1, 1] in a plane of the map: (sin, cos, sin, cos).
fn convolution_channels(z: f32, plane: u32, terms: u32) -> vec4f {
    return convolution_waves(convolution_place(z, terms), plane);
}

// The texel to write for averaged channels.
fn convolution_to_texel(channels: vec4f, stored_as: u32) -> vec4f {
    if !storage_is_float(stored_as) {
        return saturate(fma(vec4f(0.5), channels, vec4f(0.5)));
    }
    if stored_as == STORAGE_FLOAT16 {
        return storage_round_to_float16(channels);
    }
    return channels;
}

// The receiver's place for `convolution_plane`, in [-1, 1].
fn convolution_receiver(fragment_depth: f32, terms: u32, lower_bound: bool) -> f32 {
    let shift = select(0.0, convolution_bound(terms).x, lower_bound);
    return convolution_place(depth_of_fragment(fragment_depth), terms) - shift;
}

// What the (filtered) texel of a plane adds to the series. Lower bounds need the damping `CONVOLUTION_DAMPING`.
fn convolution_plane(texel: vec4f, stored_as: u32, plane: u32, terms: u32, receiver: f32, damping: f32) -> f32 {
    let finite = storage_finite_texel(texel, stored_as);
    let decoded = select(fma(vec4f(2.0), finite, vec4f(-1.0)), finite, storage_is_float(stored_as));
    let waves = clamp(decoded, vec4f(-1.0), vec4f(1.0));
    let at_receiver = convolution_waves(receiver, plane);
    // sin(c_k (d - z)) for both terms.
    let sines = at_receiver.xz * waves.yw - at_receiver.yw * waves.xz;
    let k = vec2f(2.0 * f32(plane)) + vec2f(1.0, 2.0);
    let count = f32(convolution_terms(terms));
    let share = k / count;
    let damped = exp(-clamp(damping, 0.0, 80.0) * min(share * share, vec2f(1.0)));
    let amplitudes = select(vec2f(0.0), damped * 2.0 / (3.141592653589793 * (2.0 * k - 1.0)), k <= vec2f(count));
    return dot(amplitudes, sines);
}

// Shadow intensity in [0, 1] (1 = shadowed) for the sum of `convolution_plane` over all planes: a lower bound, or the
// series itself.
fn convolution_shadow_intensity(sum: f32, terms: u32, lower_bound: bool) -> f32 {
    let overshoot = select(0.0, convolution_bound(terms).y, lower_bound);
    return saturate(0.5 + sum - overshoot);
}
