// Angles, to 4 units in the last place on every device.
//
// WGSL allows its built-in `atan2`, `sin` and `cos` errors of thousands of units, too much for coordinates that are made of
// angles. The functions here are polynomials on reduced ranges (Moshier, Cephes mathematical library, single precision).

// Parts of pi rounded to f32, and what that leaves of the least one. In the others it is less than half a unit in the last place.
const ANGLE_PI: f32 = 3.1415927;
const ANGLE_HALF_PI: f32 = 1.5707964;
const ANGLE_QUARTER_PI: f32 = 0.7853982;
const ANGLE_QUARTER_PI_REST: f32 = -2.1855695e-8;

// tan(pi / 8): the polynomial of the arc tangent holds up to here.
const ANGLE_TAN_EIGHTH_PI: f32 = 0.41421357;

// pi / 2 in three parts, the first two with so few digits that their products with small integers are exact.
const ANGLE_HALF_PI_FIRST: f32 = 1.5703125;
const ANGLE_HALF_PI_SECOND: f32 = 4.837512969970703125e-4;
const ANGLE_HALF_PI_THIRD: f32 = 7.54978995489188216e-8;

// Angles beyond this, about 1,500 turns, count as this angle.
const ANGLE_LARGEST: f32 = 1e4;

// The number itself, or 0 for NaN and infinities. They are found by their bits: a compiler may assume that neither occurs.
fn angle_finite(value: f32) -> f32 {
    let exponent = bitcast<u32>(value) & 0x7f800000u;
    return select(value, 0.0, exponent == 0x7f800000u);
}

// The angle in [-pi, pi] from the x-axis to (x, y). 0 for the zero vector, as which any with components below 2^-124 counts, and for
// non-finite components; pi for x < 0 and y = 0, whatever the sign of y.
fn angle_atan2(y: f32, x: f32) -> f32 {
    let finite = vec2f(angle_finite(x), angle_finite(y));
    let magnitudes = abs(finite);
    let most = max(magnitudes.x, magnitudes.y);
    // Sums and quotients stay among normal numbers.
    let scale = select(select(1.0, 5.421010862427522e-20, most > 1.8446744073709552e19), 1.8446744073709552e19, most < 9.094947017729282e-13);
    let large = most * scale;
    let small = min(magnitudes.x, magnitudes.y) * scale;
    if large < 8.673617379884035e-19 {
        return 0.0;
    }
    // atan(t) = pi / 4 + atan((t - 1) / (t + 1)).
    let steep = small > ANGLE_TAN_EIGHTH_PI * large;
    let quotient = select(small, small - large, steep) / select(large, small + large, steep);
    let square = quotient * quotient;
    let series = fma(fma(fma(8.05374449538e-2, square, -1.38776856032e-1), square, 1.99777106478e-1), square, -3.33329491539e-1);
    let rest = select(0.0, ANGLE_QUARTER_PI_REST, steep);
    var angle = select(0.0, ANGLE_QUARTER_PI, steep) + (fma(series * square, quotient, quotient) + rest);
    if magnitudes.y > magnitudes.x {
        angle = ANGLE_HALF_PI - angle;
    }
    if finite.x < 0.0 {
        angle = ANGLE_PI - angle;
    }
    return select(angle, -angle, finite.y < 0.0);
}

// Arc tangents of tangents in [0, 1].
fn angle_of_small_tangent(tangents: vec2f) -> vec2f {
    // Abramowitz & Stegun, Handbook of Mathematical Functions, 4.4.49: off by at most 2e-8.
    let square = tangents * tangents;
    var series = fma(square, vec2f(0.0028662257), vec2f(-0.0161657367));
    series = fma(series, square, vec2f(0.0429096138));
    series = fma(series, square, vec2f(-0.0752896400));
    series = fma(series, square, vec2f(0.1065626393));
    series = fma(series, square, vec2f(-0.1420889944));
    series = fma(series, square, vec2f(0.1999355085));
    series = fma(series, square, vec2f(-0.3333314528));
    return fma(series * square, tangents, tangents);
}

// Sine and cosine of an angle in radians, |angle| <= 1e4. Near their zeros the error is 2^-24 times that of an angle of the
// same size, not times the angle.
fn angle_sin_cos(angle: f32) -> vec2f {
    let bounded = clamp(angle_finite(angle), -ANGLE_LARGEST, ANGLE_LARGEST);
    let quarters = round(bounded * 0.63661977);
    let first = fma(-quarters, ANGLE_HALF_PI_FIRST, bounded);
    let x = fma(-quarters, ANGLE_HALF_PI_THIRD, fma(-quarters, ANGLE_HALF_PI_SECOND, first));
    let square = x * x;
    let odd = fma(fma(fma(-1.9515295891e-4, square, 8.3321608736e-3), square, -1.6666654611e-1) * square, x, x);
    let even = fma(fma(fma(2.443315711809948e-5, square, -1.388731625493765e-3), square, 4.166664568298827e-2), square * square, fma(-0.5, square, 1.0));
    let quadrant = i32(quarters) & 3;
    let swapped = (quadrant & 1) == 1;
    let sine = select(odd, even, swapped);
    let cosine = select(even, odd, swapped);
    return vec2f(select(sine, -sine, quadrant >= 2), select(cosine, -cosine, quadrant == 1 || quadrant == 2));
}
