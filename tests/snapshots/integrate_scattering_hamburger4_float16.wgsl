// moment_shadows/maths/angle.wgsl
// Angles, to 4 units in the last place on every device.
//
// WGSL allows its own `atan2`, `sin` and `cos` errors of thousands of units, which is no sound base for coordinates that are
// made of angles. These are polynomials on reduced ranges (Moshier, Cephes mathematical library, single precision).

// pi, and what its f32 lacks of it.
const ANGLE_PI: f32 = 3.1415927;
const ANGLE_PI_REST: f32 = -8.742278e-8;
const ANGLE_HALF_PI: f32 = 1.5707964;
const ANGLE_HALF_PI_REST: f32 = -4.371139e-8;
const ANGLE_QUARTER_PI: f32 = 0.7853982;
const ANGLE_QUARTER_PI_REST: f32 = -2.1855695e-8;

// tan(pi / 8): up to here the polynomial of the arc tangent holds.
const ANGLE_TAN_EIGHTH_PI: f32 = 0.41421357;

// pi / 2 in three parts, the first two with so few digits that their products with small integers are exact.
const ANGLE_HALF_PI_FIRST: f32 = 1.5703125;
const ANGLE_HALF_PI_SECOND: f32 = 4.837512969970703125e-4;
const ANGLE_HALF_PI_THIRD: f32 = 7.54978995489188216e-8;

// Angles beyond this, about 1,500 turns, count as this.
const ANGLE_LARGEST: f32 = 1e4;

// A number, or 0 in place of NaN and infinities. By its bits: a compiler may assume that there are none.
fn angle_finite(value: f32) -> f32 {
    let exponent = bitcast<u32>(value) & 0x7f800000u;
    return select(value, 0.0, exponent == 0x7f800000u);
}

// The angle in [-pi, pi] from the x-axis to (x, y). 0 for the zero vector and for components that are no finite numbers;
// pi for x < 0 and y = 0, whatever the sign of y.
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
        angle = ANGLE_HALF_PI - (angle - ANGLE_HALF_PI_REST);
    }
    if finite.x < 0.0 {
        angle = ANGLE_PI - (angle - ANGLE_PI_REST);
    }
    return select(angle, -angle, finite.y < 0.0);
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

// moment_shadows/air/rectified_frame.wgsl

// Rectified coordinates of a camera and a directional light, in which both view rays and light rays are lines along axes.
//
// With the camera at the origin and +z the direction in which light travels, a position has a radius r = |(x, y)|, an azimuth
// phi about the light's direction, and an inclination theta to it (Peters et al., JCGT 6(1) 2017, section 7). All view rays
// of one azimuth run through a row of a map with columns r and rows phi, each at its own constant inclination; a texel (r, phi)
// is one light ray, along which theta falls. Depth along the light, -1 at the largest inclination of the frustum and 1 at the
// smallest, then serves as the depth of a shadow map whose fragments are whole view rays.

// Filled by the host-side `RectifiedFrame`.
struct RectifiedFrame {
    // The direction of the pixel at (x, y) in normalised device coordinates is x along_x + y along_y + along_middle, divided
    // by the homogeneous coordinate of the scene its position.
    along_x: vec3f,
    // The largest radius of the frustum; positive.
    largest_radius: f32,
    along_y: vec3f,
    // The azimuth of the first row, and that of the last one less the first: in (0, 2 pi].
    first_azimuth: f32,
    along_middle: vec3f,
    azimuth_extent: f32,
    // The homogeneous coordinate of the scene for clip coordinates (x, y, stored depth, 1).
    scene_w: vec4f,
    // The homogeneous coordinate at the far end: sky, and whatever is farther, counts as this far.
    farthest_w: f32,
    // The inclinations of depth 1 and -1.
    smallest_inclination: f32,
    largest_inclination: f32,
    padding: f32,
}

// A component of a position, finite and not so large that squares overflow.
fn rectified_frame_component(value: f32) -> f32 {
    return clamp(angle_finite(value), -1e18, 1e18);
}

// Radius, azimuth in [-pi, pi] and inclination in [0, pi] of a position. The camera itself and components that are no finite
// numbers count as 0.
fn rectified_frame_coordinates(position: vec3f) -> vec3f {
    let x = rectified_frame_component(position.x);
    let y = rectified_frame_component(position.y);
    let z = rectified_frame_component(position.z);
    // Scaled, so that squares of small components do not vanish.
    let most = max(abs(x), abs(y));
    let scaled = vec2f(x, y) / max(most, 1e-30);
    let radius = most * sqrt(dot(scaled, scaled));
    return vec3f(radius, angle_atan2(y, x), angle_atan2(radius, z));
}

// The position of coordinates. On the light ray through the camera (inclination 0 or pi) the distance is unknown; the camera's
// own position stands for all of it.
fn rectified_frame_position(coordinates: vec3f) -> vec3f {
    let around = angle_sin_cos(coordinates.y);
    let inclined = angle_sin_cos(clamp(angle_finite(coordinates.z), 0.0, ANGLE_PI));
    let radius = rectified_frame_component(coordinates.x);
    // sin(theta) of the nearest f32 to pi is -9e-8; below that there is no such inclination.
    let along = select(0.0, radius * inclined.y / inclined.x, inclined.x > 1e-7);
    return vec3f(radius * around.y, radius * around.x, along);
}

// How far across the map's columns and rows coordinates lie, from 0 to 1. Azimuths outside of the frame take its nearer end.
fn rectified_frame_place(frame: RectifiedFrame, coordinates: vec3f) -> vec2f {
    let turn = 2.0 * ANGLE_PI;
    let turned = coordinates.y - frame.first_azimuth;
    let offset = turned - turn * floor(turned / turn);
    let beyond = offset - frame.azimuth_extent;
    // Of what the frame leaves of a turn, the second half is nearer to its beginning.
    let before = beyond > 0.5 * (turn - frame.azimuth_extent);
    let row = select(offset / frame.azimuth_extent, 0.0, before);
    return saturate(vec2f(coordinates.x / frame.largest_radius, row));
}

// Radius and azimuth at a place.
fn rectified_frame_ray(frame: RectifiedFrame, place: vec2f) -> vec2f {
    return vec2f(place.x * frame.largest_radius, fma(place.y, frame.azimuth_extent, frame.first_azimuth));
}

// The depth along the light in [-1, 1] of an inclination.
fn rectified_frame_depth(frame: RectifiedFrame, inclination: f32) -> f32 {
    let extent = frame.largest_inclination - frame.smallest_inclination;
    return clamp(fma(2.0 / extent, frame.largest_inclination - inclination, -1.0), -1.0, 1.0);
}

// The inclination of a depth in [-1, 1].
fn rectified_frame_inclination(frame: RectifiedFrame, depth: f32) -> f32 {
    return mix(frame.largest_inclination, frame.smallest_inclination, 0.5 * depth + 0.5);
}

// The position of a pixel's surface, or where its view ray ends at the far end. `device` are normalised device coordinates.
fn rectified_frame_surface(frame: RectifiedFrame, device: vec2f, stored_depth: f32) -> vec3f {
    let direction = fma(vec3f(device.x), frame.along_x, fma(vec3f(device.y), frame.along_y, frame.along_middle));
    let scene_w = angle_finite(dot(frame.scene_w, vec4f(device, stored_depth, 1.0)));
    return direction / max(scene_w, frame.farthest_w);
}

// Where in a map of so many rows a row lies, from 0 to 1: the first and last rows are the ends of the frame.
fn rectified_frame_row(row: f32, rows: f32) -> f32 {
    return fma(row, rows - 1.0, 0.5) / rows;
}

// Where in a map of so many columns the prefix sums up to one lie, from 0 to 1: a texel holds the sum up to its far edge, and is
// right for view rays that end at the next column's middle. So no column is counted whose middle lies beyond a ray's end, where
// what the ray ends at no longer shadows it.
fn rectified_frame_prefix(column: f32, columns: f32) -> f32 {
    return column - 1.0 / columns;
}

// moment_shadows/air/scattering_weights.wgsl

// Weights of the columns of a rectified map: the transmittance between the camera and a column.
//
// A view ray of inclination theta reaches radius r after the distance r / sin(theta), so a column's transmittance is
// exp(-extinction r / sin(theta)) and depends on the view ray, while a row of prefix sums serves all view rays of its
// azimuth. The papers leave open which of them it is made for. Weights for another sine are off in the rate of their
// exponentials alone, by the ratio of the sines; where nothing is extinguished there is no error.
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
// Without any transmittance it is 0.012, 0.123, 0.237 and 0.484 whatever the sines.

// The part of the inclinations in [low, high] at which directions of an azimuth are on the inner side of a plane through the
// camera with a normal, where the azimuth has the given cosine and sine.
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

// The smallest and largest inclination of the frustum's view rays of an azimuth.
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
    // Rows that see nothing but the light's own direction have no columns to weight.
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

// specialization
const GROUP = 0;
alias MomentsStorage = texture_storage_2d<rgba16float, write>;
const STORAGE = 1u;

// integrate_target

// What both ways to sum up rows share.

struct IntegrateScatteringParameters {
    frame: RectifiedFrame,
    // Per scene unit; at least 0.
    extinction: f32,
}

@group(GROUP) @binding(0) var<uniform> parameters: IntegrateScatteringParameters;
@group(GROUP) @binding(1) var rectified_map: texture_2d<f32>;
@group(GROUP) @binding(2) var integrated_map: MomentsStorage;

// The optical thickness of a column of a row.
fn row_thickness(row: u32) -> f32 {
    let size = textureDimensions(rectified_map);
    let place = f32(row) / f32(max(size.y, 2u) - 1u);
    let azimuth = rectified_frame_ray(parameters.frame, vec2f(0.0, place)).y;
    return scattering_weights_thickness(parameters.frame, azimuth, parameters.extinction, f32(size.x));
}

// moment_shadows/map/storage.wgsl
// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that its bound has to
// cover. Nothing here depends on a technique: how one spreads its quantities over the range of a storage is its own.

// Storages, as a shader's specialisation names them.
const STORAGE_UNORM16: u32 = 0u;
const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;
const STORAGE_UNORM8: u32 = 3u;
// Sums of channels as unorm16 has them; see `summed_area_encoding`.
const STORAGE_FIXED32: u32 = 4u;
// Three channels to a texel, in maps that are drawn.
const STORAGE_UNORM10: u32 = 5u;

// The largest finite float16.
const STORAGE_LARGEST_FLOAT16: f32 = 65504.0;

// Whether the channels of the storage are floats, which can be anything, rather than numbers in [0, 1].
fn storage_is_float(storage: u32) -> bool {
    return storage == STORAGE_FLOAT16 || storage == STORAGE_FLOAT32;
}

// The nearest float16 of each component, ties to even, for |value| <= 65504. A driver may truncate when it stores to a
// float16 texture, which would double the rounding error that a bound has to cover.
fn storage_round_to_float16(value: vec4f) -> vec4f {
    let bits = bitcast<vec4u>(value);
    // 13 of 23 mantissa bits go; adding just under half a unit, plus the last kept bit, rounds ties to even.
    let rounded = bitcast<vec4f>((bits + 0xfffu + ((bits >> vec4u(13u)) & vec4u(1u))) & vec4u(0xffffe000u));
    // Below 2^-14 float16 is a fixed-point format with a step of 2^-24.
    let small = round(value * 16777216.0) * 5.960464477539063e-8;
    return select(rounded, small, abs(value) < vec4f(6.103515625e-5));
}

// What to draw so that a target of 10 bits per channel holds the nearest number to each component, for any finite value. A driver
// may round down, or round to 16 bits and drop the last six (lavapipe does): a little above that number they give it all the same.
fn storage_round_to_unorm10(value: vec4f) -> vec4f {
    return (round(saturate(value) * 1023.0) + 0.00390625) / 1023.0;
}

// A filtered combination of texels, as it has to be written back to the same storage.
fn storage_round_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    if storage == STORAGE_UNORM10 {
        return storage_round_to_unorm10(texel);
    }
    return texel;
}

// A texel in which channels that are NaN or infinite count as 0, found by their bits since a compiler may assume that
// there is neither. Unorm texels pass as they are.
fn storage_finite_texel(texel: vec4f, storage: u32) -> vec4f {
    if !storage_is_float(storage) {
        return texel;
    }
    let exponent = bitcast<vec4u>(texel) & vec4u(0x7f800000u);
    return select(texel, vec4f(0.0), exponent == vec4u(0x7f800000u));
}

// map_filtering

// Texels that any filter averages.

fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

// integrate_scattering_parallel.wgsl

// Normalised prefix sums along rows, on a GPU: a workgroup per row, 8 texels per invocation, the sums of invocations by the
// scan of Hillis and Steele (1986). Sums are f32 and are rounded once, to the storage.

const THREADS = 64u;
const TEXELS = 8u;

var<workgroup> sums: array<vec4f, THREADS>;
var<workgroup> weights: array<f32, THREADS>;

@compute @workgroup_size(THREADS)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u) {
    let columns = textureDimensions(rectified_map).x;
    let row = workgroup.y;
    let thickness = row_thickness(row);
    let thread = local.x;
    var before = vec4f(0.0);
    var weight_before = 0.0;
    for (var start = 0u; start < columns; start += THREADS * TEXELS) {
        let first = start + thread * TEXELS;
        var sum = vec4f(0.0);
        var weight = 0.0;
        var prefixes: array<vec4f, TEXELS>;
        var prefix_weights: array<f32, TEXELS>;
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            let of_column = scattering_weights_of_column(thickness, f32(column));
            let texel = textureLoad(rectified_map, vec2u(min(column, columns - 1u), row), 0);
            sum = fma(vec4f(of_column), texel, sum);
            weight += of_column;
            prefixes[index] = sum;
            prefix_weights[index] = weight;
        }
        sums[thread] = sum;
        weights[thread] = weight;
        workgroupBarrier();
        for (var step = 1u; step < THREADS; step *= 2u) {
            let other = max(thread, step) - step;
            let added = select(vec4f(0.0), sums[other], thread >= step);
            let added_weight = select(0.0, weights[other], thread >= step);
            workgroupBarrier();
            sums[thread] += added;
            weights[thread] += added_weight;
            workgroupBarrier();
        }
        let previous = max(thread, 1u) - 1u;
        let inner = before + select(vec4f(0.0), sums[previous], thread > 0u);
        let inner_weight = weight_before + select(0.0, weights[previous], thread > 0u);
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            if column < columns {
                // The first weight is 1.
                let mean = (inner + prefixes[index]) / (inner_weight + prefix_weights[index]);
                textureStore(integrated_map, vec2u(column, row), filtering_texel(mean));
            }
        }
        before += sums[THREADS - 1u];
        weight_before += weights[THREADS - 1u];
        workgroupBarrier();
    }
}
