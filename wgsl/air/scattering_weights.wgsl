import super::super::maths::angle::{ANGLE_HALF_PI, angle_atan2, angle_sin_cos};
import super::super::air::rectified_frame::{RectifiedFrame};

// Weights of the columns of a rectified map: the transmittance between the camera and a column.
//
// A view ray of inclination theta reaches radius r after the distance r / sin(theta), so a column's transmittance is
// exp(-extinction r / sin(theta)) and depends on the view ray, while a row of prefix sums serves all view rays of its
// azimuth. The papers leave open for which of them it is made. Weights for another sine are off only in the rate of their
// exponentials, by the ratio of the sines; without extinction there is no error.
//
// Here that sine is the mean of the smallest and largest one of the row's view rays, which is best in a thin medium and
// nearly so in a thick one. The largest error of the shadowed share of a ray, over all view rays of a row and all
// occluders that begin somewhere on it, by the ratio of the row's sines and the optical thickness of the ray:
//
//              thickness 0.1     1       2       5
//   sines 1:1.2     0.001   0.011   0.020   0.033
//         1:1.5     0.003   0.024   0.045   0.076
//         1:2       0.004   0.041   0.076   0.133
//         1:4       0.008   0.074   0.140   0.263
//
// Without transmittance in the weights it is 0.012, 0.123, 0.237 and 0.484 whatever the sines.

// The part of the inclinations in [low, high] at which directions of an azimuth, given by its cosine and sine, are on the
// inner side of a plane through the camera with a normal.
fn scattering_weights_clip(range: vec2f, normal: vec3f, around: vec2f) -> vec2f {
    // sin(theta) a + cos(theta) b >= 0: a half turn about the angle of (b, a), one end of which is in [0, pi].
    let middle = angle_atan2(dot(normal.xy, around), normal.z);
    if middle < -ANGLE_HALF_PI {
        return vec2f(max(range.x, middle + 3.0 * ANGLE_HALF_PI), range.y);
    }
    if middle <= ANGLE_HALF_PI {
        return vec2f(range.x, min(range.y, middle + ANGLE_HALF_PI));
    }
    return vec2f(max(range.x, middle - ANGLE_HALF_PI), range.y);
}

// The smallest and largest inclination among the frustum's view rays at an azimuth.
fn scattering_weights_inclinations(frame: RectifiedFrame, azimuth: f32) -> vec2f {
    let turn = angle_sin_cos(azimuth);
    let around = turn.yx;
    var range = vec2f(frame.smallest_inclination, frame.largest_inclination);
    for (var side = 0u; side < 4u; side++) {
        // The side planes: x + 1, 1 - x, y + 1 and 1 - y are not negative in the picture.
        let across = select(frame.along_y, frame.along_x, side < 2u);
        let along = select(frame.along_x, frame.along_y, side < 2u);
        let edge = frame.along_middle + select(across, -across, (side & 1u) == 0u);
        let normal = cross(edge, along);
        let inner = dot(normal, frame.along_middle) >= 0.0;
        range = scattering_weights_clip(range, select(-normal, normal, inner), around);
    }
    // Rows at the very ends of the frame may miss the frustum by a rounding error.
    return vec2f(min(range.x, range.y), max(range.x, range.y));
}

// The sine of the inclination that a row of this azimuth is weighted for.
fn scattering_weights_reference_sine(frame: RectifiedFrame, azimuth: f32) -> f32 {
    let range = scattering_weights_inclinations(frame, azimuth);
    let ends = vec2f(angle_sin_cos(range.x).x, angle_sin_cos(range.y).x);
    let across = range.x <= ANGLE_HALF_PI && range.y >= ANGLE_HALF_PI;
    let largest = select(max(ends.x, ends.y), 1.0, across);
    // Rows that see only the light's direction have no columns to weight.
    return max(0.5 * (min(ends.x, ends.y) + largest), 1e-6);
}

// The optical thickness of a column of a row: its weight is exp(-thickness column).
fn scattering_weights_thickness(frame: RectifiedFrame, azimuth: f32, extinction: f32, columns: f32) -> f32 {
    let width = frame.largest_radius / columns;
    return max(extinction, 0.0) * width / scattering_weights_reference_sine(frame, azimuth);
}

// The weight of a column.
fn scattering_weights_of_column(thickness: f32, column: f32) -> f32 {
    return exp(-min(thickness * column, 1e4));
}

// A view ray's own weights differ from those of its row by the factor exp(-tilt u), where u grows from 0 at the camera to 1 at its
// end. A line stands for that factor: 1 + tilt (1/2 - u), whose integral and first moment are the same up to the tilt's
// square. For tilts in [-2, 2] it is nowhere negative, so that sums with it are moments still; larger ones count as those. With
// it rows need the sums of texels and of texels times their columns, and every place of a row has the weights of the view rays that
// end there. The largest errors of the table above become
//
//              thickness 0.1     1       2       5
//   sines 1:1.2     0.000   0.000   0.001   0.004
//         1:1.5     0.000   0.001   0.003   0.026
//         1:2       0.000   0.001   0.009   0.118
//         1:4       0.000   0.006   0.036   0.244

// The tilt of view rays that end in the column after `column`, and whose inclination has this sine; 0 if it is not known, which a
// sine of 0 says. In [-2, 2]. `thickness` is that of the row's columns.
fn scattering_weights_tilt(frame: RectifiedFrame, extinction: f32, thickness: f32, sine: f32, column: f32, columns: f32) -> f32 {
    let own = max(extinction, 0.0) * (frame.largest_radius / columns) / max(sine, 1e-6);
    // Finite, so that the difference is a number.
    let tilt = (min(own, 1e30) - min(thickness, 1e30)) * (column + 1.5);
    return select(clamp(tilt, -2.0, 2.0), 0.0, sine <= 0.0);
}
