// fullscreen
// The vertex stage of fullscreen passes.

struct Covered {
    @builtin(position) position: vec4f,
    // The place in the picture from 0 to 1. Other than `position` it does not depend on where in its target a host has the
    // viewport.
    @location(0) uv: vec2f,
}

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> Covered {
    // One triangle that covers the viewport: (-1, -1), (3, -1), (-1, 3).
    let corner = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    return Covered(vec4f(corner, 0.0, 1.0), 0.5 + vec2f(0.5, -0.5) * corner);
}

// moment_shadows/map/map_region.wgsl
// Regions: rectangles of a layer that share an atlas and know nothing of each other.
//
// Mip level k of a region runs from floor(first / 2^k) to floor(end / 2^k). Regions that touch share that edge on every
// level, wherever it lies, so none covers a texel of another, and a gutter is not needed.

// Filled by the host-side `MapRegion`: texels of mip level 0. No texels: no region. A rectangle that leaves the map is
// cut off at its border.
struct MapRegion {
    origin: vec2u,
    extent: vec2u,
}

// The part of a region that lies in a map of `size` texels.
fn map_region_within(region: MapRegion, size: vec2u) -> MapRegion {
    let origin = min(region.origin, size);
    return MapRegion(origin, min(region.extent, size - origin));
}

// A region of a map (within it) on mip level `level`, below 32.
fn map_region_at_level(region: MapRegion, level: u32) -> MapRegion {
    let origin = region.origin >> vec2u(level);
    return MapRegion(origin, ((region.origin + region.extent) >> vec2u(level)) - origin);
}

// The coarsest of `levels` mip levels on which a region still has texels.
fn map_region_last_level(region: MapRegion, levels: u32) -> u32 {
    var level = max(levels, 1u) - 1u;
    while level > 0u && any(map_region_at_level(region, level).extent == vec2u(0u)) {
        level--;
    }
    return level;
}

// The place of `uv` (from 0 to 1 across the region) in texels of a region's mip level, kept half a texel away from its
// edge: a bilinear filter there reads no other region.
fn map_region_place(region_on_level: MapRegion, uv: vec2f) -> vec2f {
    let extent = vec2f(region_on_level.extent);
    return vec2f(region_on_level.origin) + clamp(uv * extent, vec2f(0.5), max(extent - 0.5, vec2f(0.5)));
}

// moment_shadows/map/minification.wgsl
// Minification: what part of a map a pixel covers.
//
// A pixel maps to a parallelogram of texels. Its singular values are the axes of the ellipse that stands for it
// (Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, section 3.5): a lookup takes probes along the
// major axis, each on a mip level that fits the minor axis. Averages of moments are moments, which is what filterable
// shadow maps exist for (Donnelly & Lauritzen, "Variance Shadow Maps", i3D 2006, section 3).
//
// A pixel averages a box: over w texels its variance is w^2 / 12. A trilinear lookup on a mip level whose texels are t wide
// averages boxes of t and blends neighbours that are t apart: (1/12 + 1/6) t^2. Lookups are as wide as pixels if their
// variances are equal, t = w / sqrt(3); a level with t = w, as colour textures take it, would filter three times as much.

// Probes along the major axis, at most.
const MINIFICATION_LARGEST_ANISOTROPY: f32 = 16.0;

// The width of a mip level's texels that makes trilinear lookups as wide as a box: 1 / sqrt(3).
const MINIFICATION_TEXEL_PER_WIDTH: f32 = 0.57735026;

struct MinificationFootprint {
    // The line on which the probes lie, along the major axis and from end to end, in texels of mip level 0.
    major: vec2f,
    // Probes along it, a whole number from 1 to 16.
    probes: f32,
    // The mip level of each probe, at least 0.
    level: f32,
}

// The footprint of a pixel from the differences of place, in texels, to its neighbours in x and y; each component at
// most 1e9 in magnitude. `anisotropy`, from 1 to 16, is the largest number of probes; where more were needed, the minor
// axis is taken for longer than it is.
fn minification_footprint(difference_x: vec2f, difference_y: vec2f, anisotropy: f32) -> MinificationFootprint {
    let xx = difference_x.x * difference_x.x + difference_y.x * difference_y.x;
    let xy = difference_x.x * difference_x.y + difference_y.x * difference_y.y;
    let yy = difference_x.y * difference_x.y + difference_y.y * difference_y.y;
    // The squares of the axes are the eigenvalues of the symmetric matrix (xx xy, xy yy).
    let half_difference = 0.5 * (xx - yy);
    let root = sqrt(half_difference * half_difference + xy * xy);
    let major_length = sqrt(0.5 * (xx + yy) + root);
    // The product of the axes is the parallelogram's area; a difference of eigenvalues would cancel.
    let area = abs(difference_x.x * difference_y.y - difference_x.y * difference_y.x);
    let minor_length = area / max(major_length, 1e-20);
    // Both rows of the matrix less its smaller eigenvalue point along the major axis; this is the one that does not cancel.
    let along = select(vec2f(xy, root - half_difference), vec2f(root + half_difference, xy), half_difference >= 0.0);
    // A circle has no direction; its probes number one.
    let direction = along / max(max(abs(along.x), abs(along.y)), 1e-30);
    let unit = direction / max(length(direction), 1e-6);
    let largest = clamp(anisotropy, 1.0, MINIFICATION_LARGEST_ANISOTROPY);
    // With so many probes a texel apart the major axis is filled: w^2 = 3 major_length^2 / (largest^2 + 2).
    let filled = major_length * sqrt(3.0 / fma(largest, largest, 2.0));
    let width = max(max(minor_length, filled), 1.0);
    // A probe has the variance of the width along the major axis, too: the line of probes is shorter by that.
    let line = sqrt(max(fma(-width, width, major_length * major_length), 0.0));
    let texel = max(width * MINIFICATION_TEXEL_PER_WIDTH, 1.0);
    return MinificationFootprint(unit * line, clamp(ceil(line / texel - 1e-3), 1.0, largest), log2(texel));
}

// Where probe `index` lies on the major axis: the offset, in texels, from the footprint's centre.
fn minification_probe(footprint: MinificationFootprint, index: f32) -> vec2f {
    return ((index + 0.5) / footprint.probes - 0.5) * footprint.major;
}

// The two axes of a footprint as the differences of place, in texels, that make a sampler with anisotropy take just these
// probes: x is the column of the line, at least as long as the other one.
fn minification_gradients(footprint: MinificationFootprint) -> mat2x2f {
    let texel = exp2(footprint.level);
    let line = length(footprint.major);
    let unit = select(vec2f(1.0, 0.0), footprint.major / max(line, 1e-6), line >= 1e-3);
    return mat2x2f(unit * max(line, texel), vec2f(-unit.y, unit.x) * texel);
}

// The variance that minification adds to the moment depths of a plane, whose moment depth changes by `gradient` per texel:
// that of the probes' trilinear lookups, and that of the line they lie on. Between two levels the mixture of both has at
// most 1.13 times the variance of the level between them.
fn minification_depth_variance(footprint: MinificationFootprint, gradient: vec2f) -> f32 {
    let texel = select(0.0, exp2(footprint.level), footprint.level > 0.0);
    let across = texel * length(gradient);
    let along = select(0.0, dot(footprint.major, gradient), footprint.probes > 1.0);
    return (1.13 / 4.0) * across * across + along * along / 12.0;
}

// moment_shadows/map/map_load.wgsl

// Lookups in a map that a device cannot filter, and where a sampler would read across the edge of a region: bilinear,
// trilinear, averaged over a footprint. `uv`, `levels` and regions are those of `map_lookup`.
//
// Texels are loaded and blended here, in f32, while hardware may use weights of as few as 8 bits. Blending texels of moments
// is a convex combination, so it keeps moments valid.

// The bilinearly filtered texel on one mip level. `uv` is finite; values outside [0, 1] count as the nearer edge.
fn map_load_bilinear(map: texture_2d_array<f32>, layer: u32, region: MapRegion, uv: vec2f, level: u32) -> vec4f {
    let rectangle = map_region_at_level(region, level);
    let place = map_region_place(rectangle, uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(rectangle.origin + rectangle.extent) - 1);
    let top = mix(textureLoad(map, low, layer, level), textureLoad(map, vec2i(high.x, low.y), layer, level), weight.x);
    let bottom = mix(textureLoad(map, vec2i(low.x, high.y), layer, level), textureLoad(map, high, layer, level), weight.x);
    return mix(top, bottom, weight.y);
}

// The same, blended between the two mip levels next to `level` >= 0, as far as the region has texels there.
fn map_load_trilinear(map: texture_2d_array<f32>, layer: u32, region: MapRegion, levels: u32, uv: vec2f, level: f32) -> vec4f {
    let last = map_region_last_level(region, levels);
    let fine = min(u32(clamp(level, 0.0, 31.0)), last);
    let texel = map_load_bilinear(map, layer, region, uv, fine);
    let blend = level - f32(fine);
    if fine == last || blend <= 0.0 {
        return texel;
    }
    return mix(texel, map_load_bilinear(map, layer, region, uv, fine + 1u), blend);
}

// The average over a footprint around `uv`: trilinear probes along its major axis.
fn map_load_footprint(map: texture_2d_array<f32>, layer: u32, region: MapRegion, levels: u32, uv: vec2f, footprint: MinificationFootprint) -> vec4f {
    let per_texel = 1.0 / max(vec2f(region.extent), vec2f(1.0));
    var sum = vec4f(0.0);
    for (var probe = 0.0; probe < footprint.probes; probe += 1.0) {
        let probe_uv = uv + minification_probe(footprint, probe) * per_texel;
        sum += map_load_trilinear(map, layer, region, levels, probe_uv, footprint.level);
    }
    return sum / footprint.probes;
}

// moment_shadows/map/map_lookup.wgsl

// Lookups in a filterable map by a sampler: bilinear, and averaged over a pixel. None reads across the edge of a region.
//
// `uv` runs from 0 to 1 across the region, v downwards; places are in texels of mip level 0. `levels` is the number of mip
// levels of the map. Samplers filter linearly within and between levels and clamp to the edge. `map_load` has lookups for
// maps that a device cannot filter.

// The bilinearly filtered texel on one mip level. The sampler is not anisotropic: a driver may apply anisotropy to lookups
// with an explicit level, too, and then they reach beyond the region.
fn map_lookup_bilinear(map: texture_2d_array<f32>, linear: sampler, layer: u32, region: MapRegion, uv: vec2f, level: u32) -> vec4f {
    let place = map_region_place(map_region_at_level(region, level), uv);
    return textureSampleLevel(map, linear, place / vec2f(textureDimensions(map, level)), layer, f32(level));
}

// The average over a pixel, from the differences of place to its neighbours in x and y, in texels, each component at
// most 1e9 in magnitude. Where the pixel's footprint lies well within a region that hardware would divide into the same
// mip levels, hardware takes the probes, at most as many as the clamp of the sampler `anisotropic`; elsewhere at most
// `anisotropy` are taken here, from loaded texels. Regions are read by hardware for the most part if their edges and the
// size of the map are multiples of a texel of the coarsest level.
fn map_lookup_gradient(map: texture_2d_array<f32>, anisotropic: sampler, layer: u32, region: MapRegion, levels: u32, uv: vec2f, difference_x: vec2f, difference_y: vec2f, anisotropy: f32) -> vec4f {
    let footprint = minification_footprint(difference_x, difference_y, anisotropy);
    let size = textureDimensions(map);
    let place = vec2f(region.origin) + uv * vec2f(region.extent);
    let whole = all(region.origin == vec2u(0u)) && all(region.extent == size);
    if whole || map_lookup_is_inner(region, size, levels, place, abs(difference_x) + abs(difference_y)) {
        let per_texel = 1.0 / vec2f(size);
        let gradients = minification_gradients(footprint);
        return textureSampleGrad(map, anisotropic, place * per_texel, layer, gradients[0] * per_texel, gradients[1] * per_texel);
    }
    return map_load_footprint(map, layer, region, levels, uv, footprint);
}

// Whether hardware that filters around `place` over a box of `reach` texels reads no texel of another region, and divides
// the map into mip levels just as regions are divided: edges and size are multiples of a texel of the coarsest level.
fn map_lookup_is_inner(region: MapRegion, size: vec2u, levels: u32, place: vec2f, reach: vec2f) -> bool {
    let part_of_texel = vec2u((1u << min(max(levels, 1u) - 1u, 31u)) - 1u);
    let aligned = all(((region.origin | region.extent | size) & part_of_texel) == vec2u(0u));
    // Half of the box, and two texels of a mip level whose texels may be twice as wide as the box is long.
    let margin = vec2f(2.0) + 0.5 * reach + 4.0 * max(reach.x, reach.y);
    let low = vec2f(region.origin) + margin;
    let high = vec2f(region.origin + region.extent) - margin;
    return aligned && all(place >= low) && all(place <= high);
}

// specialization
const GROUP = 0;
const LEVELS = 1u;
const ANISOTROPY = 1.0;
const OVERESTIMATION = vec2f(0.2, 0.35);
alias MomentsStorage = texture_storage_2d<rgba16float, write>;
const STORAGE = 1u;

// moments_lookup

// The lookup in a map that the device can filter, without mip levels.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var moments_sampler: sampler;

// The bilinearly filtered texel at `uv` in [0, 1] across a region. How far apart pixels lie does not matter.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    return map_lookup_bilinear(moments_map, moments_sampler, layer, region, uv, 0u);
}

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

// moment_shadows/maths/hankel.wgsl
// The shared factorisation: LDL^T of the Hankel matrix of four moments.
//
//       | 1  b1 b2 |
//   B = | b1 b2 b3 |     B is positive semi-definite exactly if some distribution on the real line has these moments
//       | b2 b3 b4 |     (Hamburger moment problem; Peters & Klein, i3D 2015, section 2.2 and Algorithm 3).
//
// Its pivots define the monic orthogonal polynomials of the distribution, with x = z - b1:
//   P0 = 1,  P1(x) = x,  P2(x) = x (x - shift) - variance,
// with squared norms 1, variance and residue. The roots of P2 are the two Gauss nodes.

// The pivots of B and what the orthogonal polynomials need.
struct HankelFactor {
    // b2 - b1^2, the variance of z; positive.
    variance: f32,
    // The Schur complement of b4, the variance of z^2 that z does not explain; positive.
    residue: f32,
    // residue / variance.
    ratio: f32,
    // L32 - 2 b1, with L32 the slope of the regression of z^2 on z.
    shift: f32,
}

// Pivots of valid moments stay above these multiples of the moment bias alpha, so the guards bind only where rounding
// has left the pivots without a correct digit (or the moments are none). They also bound all that is divided by a pivot:
// with alpha >= 1e-7 nothing below overflows on the way to a weight, whatever the moments.
const HANKEL_SMALLEST_VARIANCE: f32 = 0.03;
const HANKEL_SMALLEST_RESIDUE: f32 = 0.02;

// Factorises the Hankel matrix of moments biased by `alpha` >= 1e-7. Moments must lie within [-2.1, 2.1].
// The differences of products lose almost all digits near a single surface; `fma` keeps them where it is fused.
fn hankel_factor(biased: vec4f, alpha: f32) -> HankelFactor {
    let variance = max(fma(-biased.x, biased.x, biased.y), HANKEL_SMALLEST_VARIANCE * alpha);
    // One division for all quotients.
    let inverse = 1.0 / variance;
    let covariance = fma(-biased.x, biased.y, biased.z);
    let slope = covariance * inverse;
    let residue = max(
        fma(-covariance, slope, fma(-biased.y, biased.y, biased.w)),
        HANKEL_SMALLEST_RESIDUE * alpha,
    );
    return HankelFactor(variance, residue, residue * inverse, fma(-2.0, biased.x, slope));
}

// P2 at x = z - b1. Negative exactly between the Gauss nodes.
fn hankel_second_polynomial(factor: HankelFactor, x: f32) -> f32 {
    return fma(x, x - factor.shift, -factor.variance);
}

// The Christoffel number of x = z - b1, 1 / (1 + x^2 / variance + P2^2 / residue): the largest weight that a distribution
// with these moments can have at z, which is the weight that the extremal distribution through z has there. A sum of
// positive terms, here times the residue: nothing cancels.
fn hankel_christoffel_number(factor: HankelFactor, x: f32, second_polynomial: f32) -> f32 {
    let x_term = fma(x * factor.ratio, x, factor.residue);
    return factor.residue / fma(second_polynomial, second_polynomial, x_term);
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

// moment_shadows/moments/six_moments.wgsl

// Six moments of depth: encoding, storage, bias.
//
// A map holds b = (E[z], ..., E[z^6]) of the moment depths z in [-1, 1] that a texel covers, in two texels: the odd moments
// in one, the even ones in the other, since the optimised basis mixes neither with the other (Peters, GDC 2016; Peters et
// al., JCGT 6(1) 2017). Like that of four moments it spreads the moments over the range of every channel, and commutes
// with filtering.

// The moments of one distribution.
struct SixMoments {
    // E[z], E[z^3], E[z^5].
    odd: vec3f,
    // E[z^2], E[z^4], E[z^6].
    even: vec3f,
}

// A moment bias: b is moved by alpha towards moments whose odd ones are 0.
struct SixMomentsBias {
    // The target's E[z^2], E[z^4], E[z^6].
    even: vec3f,
    alpha: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions. 3e-6 would do so for float32, but below 8e-6 what is left of
// the last pivot of `hamburger6` in f32 can be nothing but rounding. 5e-3 would do so for unorm10, but a search for the worst regions
// finds some that need up to 6.5e-3, and with 5.5e-3 the bound exceeds the truth of one of them by 2.7e-2. The target is the
// one published for moment-based transparency (Muenstermann et al., "Moment-Based Order-Independent Transparency", i3D 2018).
const SIX_MOMENTS_BIAS_TARGET: vec3f = vec3f(0.5566, 0.489, 0.47869382);
const SIX_MOMENTS_BIAS_UNORM16: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1e-4);
const SIX_MOMENTS_BIAS_FLOAT16: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1.5e-3);
const SIX_MOMENTS_BIAS_FLOAT32: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 1e-5);
const SIX_MOMENTS_BIAS_UNORM10: SixMomentsBias = SixMomentsBias(SIX_MOMENTS_BIAS_TARGET, 6.5e-3);

// The optimised basis, by columns: these products plus the offsets map the odd and the even moments of depths in [-1, 1]
// into [0, 1]^3 each.
const SIX_MOMENTS_ODD_BASIS: mat3x3f = mat3x3f(
    2.5, -1.8749986445, 1.26583039016,
    -10.0, 4.20757543111, -1.47644882902,
    8.0, -1.83257678661, 0.71061660238,
);
const SIX_MOMENTS_EVEN_BASIS: mat3x3f = mat3x3f(
    4.0, 9.0, -0.57759806484,
    -4.0, -24.0, 4.61936647543,
    0.0, 16.0, -3.07953906655,
);
const SIX_MOMENTS_ODD_OFFSET: vec3f = vec3f(0.5);
const SIX_MOMENTS_EVEN_OFFSET: vec3f = vec3f(0.0, 0.0, 0.018888946);

// Their inverses, by columns.
const SIX_MOMENTS_ODD_INVERSE: mat3x3f = mat3x3f(
    -0.02877789191977914, 0.09995235706024454, 0.25893353755023666,
    0.4763555042123262, 0.8453258093069343, 0.907796166567316,
    1.5524280897137293, 1.0547257075981561, 0.8332733564621547,
);
const SIX_MOMENTS_EVEN_INVERSE: mat3x3f = mat3x3f(
    1.2530436076429571e-5, -0.24998746956392357, -0.37498825271617835,
    0.16668494186053159, 0.16668494186053159, 0.21876713299424836,
    0.866025405794346, 0.866025405794346, 0.8118988179321994,
);

// matrix * vector + offset, every step fused where the hardware does.
fn six_moments_affine(matrix: mat3x3f, vector: vec3f, offset: vec3f) -> vec3f {
    let last = fma(matrix[2], vector.zzz, offset);
    return fma(matrix[0], vector.xxx, fma(matrix[1], vector.yyy, last));
}

// The moments of a single depth z in [-1, 1]: its powers.
fn six_moments_from_depth(z: f32) -> SixMoments {
    let square = z * z;
    let powers = vec3f(1.0, square, square * square);
    return SixMoments(z * powers, square * powers);
}

// What is subtracted from channels before they are stored: floats are finest around zero.
fn six_moments_middle(storage: u32) -> f32 {
    return select(0.0, 0.5, storage_is_float(storage));
}

// A texel of three channels, with 1 in the fourth.
fn six_moments_texel(channels: vec3f, storage: u32) -> vec4f {
    return storage_round_texel(vec4f(saturate(channels) - six_moments_middle(storage), 1.0), storage);
}

// What to write to the first texel of the storage: the odd moments.
fn six_moments_to_odd_texel(odd: vec3f, storage: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_ODD_BASIS, odd, SIX_MOMENTS_ODD_OFFSET), storage);
}

// What to write to the second one: the even moments.
fn six_moments_to_even_texel(even: vec3f, storage: u32) -> vec4f {
    return six_moments_texel(six_moments_affine(SIX_MOMENTS_EVEN_BASIS, even, SIX_MOMENTS_EVEN_OFFSET), storage);
}

// What is averaged for a moment depth z in [-1, 1], for one of the two texels: three odd moments for plane 0, three even ones for
// plane 1.
fn six_moments_channels(z: f32, plane: u32) -> vec4f {
    let moments = six_moments_from_depth(z);
    return vec4f(select(moments.even, moments.odd, plane == 0u), 1.0);
}

// What to write to a texel of the storage for averaged channels of a plane.
fn six_moments_to_texel(mean: vec4f, plane: u32, storage: u32) -> vec4f {
    if plane == 0u {
        return six_moments_to_odd_texel(mean.xyz, storage);
    }
    return six_moments_to_even_texel(mean.xyz, storage);
}

// Both texels.
fn six_moments_to_texels(b: SixMoments, storage: u32) -> array<vec4f, 2> {
    return array<vec4f, 2>(six_moments_to_odd_texel(b.odd, storage), six_moments_to_even_texel(b.even, storage));
}

// The moments in the two (filtered) texels of the storage, |b| < 1.05. Float storage can hold anything: channels beyond their
// range count as its ends. Channels and not moments are clamped, since the bias covers errors of channels; moments at the ends
// of their ranges, of which rounding has moved one inwards, would need one ten times as large if the others were clamped.
fn six_moments_from_texels(texels: array<vec4f, 2>, storage: u32) -> SixMoments {
    let middle = six_moments_middle(storage);
    var odd = texels[0].xyz;
    var even = texels[1].xyz;
    if storage_is_float(storage) {
        odd = clamp(odd, vec3f(-0.5), vec3f(0.5));
        even = clamp(even, vec3f(-0.5), vec3f(0.5));
    }
    return SixMoments(
        six_moments_affine(SIX_MOMENTS_ODD_INVERSE, odd - (SIX_MOMENTS_ODD_OFFSET - middle), vec3f(0.0)),
        six_moments_affine(SIX_MOMENTS_EVEN_INVERSE, even - (SIX_MOMENTS_EVEN_OFFSET - middle), vec3f(0.0)),
    );
}

// The moment bias of a storage.
fn six_moments_bias_of(storage: u32) -> SixMomentsBias {
    if storage == STORAGE_FLOAT32 {
        return SIX_MOMENTS_BIAS_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return SIX_MOMENTS_BIAS_FLOAT16;
    }
    if storage == STORAGE_UNORM10 {
        return SIX_MOMENTS_BIAS_UNORM10;
    }
    return SIX_MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn six_moments_apply_bias(b: SixMoments, bias: SixMomentsBias) -> SixMoments {
    let alpha = vec3f(bias.alpha);
    return SixMoments(fma(-alpha, b.odd, b.odd), fma(alpha, bias.even - b.even, b.even));
}

// moment_shadows/bounds/hamburger6.wgsl

// Hamburger six-moment shadow mapping: the sharpest bounds on shadow intensity that six moments allow.
//
// As with four moments the extremal distribution has the fragment depth in its support, and now three more points (Peters &
// Klein, i3D 2015, Proposition 3; six moments in Peters et al., JCGT 6(1) 2017). The published evaluation takes the three
// roots of a cubic by arc tangents and divides by its leading coefficient, which vanishes when the fragment is at a Gauss
// node. This one gives the same values without either:
//   - the weight of a support point is its Christoffel number, a sum of positive terms;
//   - how many support points lie in front of the fragment follows from the signs of the orthogonal polynomials (Sturm);
//   - since all weights add up to one, only the one point that is alone on its side is needed. In y = 1 / (z - fragment)
//     it is an extreme root of a cubic that never degenerates, and Laguerre's method finds it from outside.
//
// With x = z - b1 the monic orthogonal polynomials are P0 to P2 of `hankel`, and P3(x) = (x - offset) P2(x) - ratio x.

// The Hankel matrix of six moments, factorised.
struct Hamburger6Factor {
    // That of the first four moments.
    four: HankelFactor,
    // By how much x is shifted in the recurrence that makes P3.
    offset: f32,
    // One over the squared norms of P1, P2 and P3.
    inverse_norms: vec3f,
}

// P1, P2 and P3 at one place, and these over their squared norms.
struct Hamburger6Polynomials {
    values: vec3f,
    coefficients: vec3f,
    // The Christoffel number 1 / (1 + P1^2 / D1 + P2^2 / D2 + P3^2 / D3).
    weight: f32,
}

// The last pivot of valid moments stays above this multiple of the moment bias alpha, that of the bias' target being 0.049.
const HAMBURGER6_SMALLEST_PIVOT: f32 = 0.004;

// Coefficients of the recurrence are those of a distribution on [-1, 1] and below these, but for moments that are none or
// have lost all digits. They keep what follows from overflowing: with coefficients in these ranges and positive norms the
// polynomials are orthogonal for some distribution, so that everything below holds for them too.
const HAMBURGER6_LARGEST_SHIFT: f32 = 8.0;
const HAMBURGER6_LARGEST_RATIO: f32 = 4.0;

// Support points and fragments farther out than this have a weight below 1e-8 or count as being there.
const HAMBURGER6_FARTHEST_SUPPORT: f32 = 1e4;

// Steps of Laguerre's method; without enough of them errors of 0.1 remain in one of 10^4 cases.
const HAMBURGER6_STEPS: u32 = 6u;

// With a moment bias of at least this so many steps do.
const HAMBURGER6_LARGE_ALPHA: f32 = 1e-3;
const HAMBURGER6_STEPS_OF_LARGE_ALPHA: u32 = 4u;

// Factorises the Hankel matrix of moments biased by `alpha` >= 1e-7. Moments must lie within [-2, 2].
fn hamburger6_factor(biased: SixMoments, alpha: f32) -> Hamburger6Factor {
    let b = vec4f(biased.odd.x, biased.even.x, biased.odd.y, biased.even.y);
    var four = hankel_factor(b, alpha);
    four.shift = clamp(four.shift, -HAMBURGER6_LARGEST_SHIFT, HAMBURGER6_LARGEST_SHIFT);
    four.ratio = min(four.ratio, HAMBURGER6_LARGEST_RATIO);
    four.residue = min(four.residue, HAMBURGER6_LARGEST_RATIO * four.variance);
    let inverse = 1.0 / vec2f(four.variance, four.residue);
    // What the regressions of z^3 on 1 and z, and on z^2 besides, leave.
    let third = fma(-b.x, b.z, b.w);
    let third_slope = third * inverse.x;
    let fourth = fma(-fma(-b.x, b.y, b.z), third_slope, fma(-b.y, b.z, biased.odd.z));
    let fourth_slope = fourth * inverse.y;
    let pivot = fma(-fourth, fourth_slope, fma(-third, third_slope, fma(-b.z, b.z, biased.even.z)));
    let offset = fma(-3.0, b.x, fourth_slope - four.shift);
    return Hamburger6Factor(
        four,
        clamp(offset, -HAMBURGER6_LARGEST_SHIFT, HAMBURGER6_LARGEST_SHIFT),
        vec3f(inverse, 1.0 / max(pivot, HAMBURGER6_SMALLEST_PIVOT * alpha)),
    );
}

// The orthogonal polynomials and the Christoffel number at x.
fn hamburger6_polynomials(factor: Hamburger6Factor, x: f32) -> Hamburger6Polynomials {
    let second = hankel_second_polynomial(factor.four, x);
    let values = vec3f(x, second, fma(x - factor.offset, second, -factor.four.ratio * x));
    let coefficients = values * factor.inverse_norms;
    return Hamburger6Polynomials(values, coefficients, 1.0 / (1.0 + dot(values, coefficients)));
}

// How many Gauss nodes, the roots of P3, are below the place of the polynomials: agreements of neighbours' signs.
fn hamburger6_nodes_below(polynomials: Hamburger6Polynomials) -> u32 {
    let positive = vec4<bool>(true, polynomials.values >= vec3f(0.0));
    let agree = positive.xyz == positive.yzw;
    return u32(agree.x) + u32(agree.y) + u32(agree.z);
}

// The weight of the support point that is alone on its side of a fragment at x: below it if one Gauss node is (`side` 1),
// above it if two are (`side` -1).
fn hamburger6_lone_weight(factor: Hamburger6Factor, x: f32, fragment: Hamburger6Polynomials, side: f32, alpha: f32) -> f32 {
    // The kernel sum_k P_k(x) P_k(t) / D_k, which vanishes at the support points, as a polynomial in t - x, by powers of y:
    // y^3 + e2 y^2 + e1 y + e0 with only positive terms in what it was divided by.
    let k = fragment.coefficients;
    let shift = factor.four.shift;
    let second = fma(-k.z, shift + factor.offset, k.y);
    let product = fma(factor.offset, shift, -factor.four.variance - factor.four.ratio);
    let first = fma(-k.y, shift, fma(k.z, product, k.x));
    let e2 = side * fragment.weight * fma(x, fma(3.0 * k.z, x, 2.0 * second), first);
    let e1 = fragment.weight * fma(3.0 * k.z, x, second);
    let e0 = side * fragment.weight * k.z;
    // The only negative root, from a place that is left of all roots. Steps only lead towards it.
    const nearest_to_zero: f32 = -1.0 / HAMBURGER6_FARTHEST_SUPPORT;
    var y = min(-(e2 + 2.0 * sqrt(max(fma(e2, e2, -3.0 * e1), 0.0))) / 3.0, nearest_to_zero);
    let steps = select(HAMBURGER6_STEPS, HAMBURGER6_STEPS_OF_LARGE_ALPHA, alpha >= HAMBURGER6_LARGE_ALPHA);
    for (var step = 0u; step < steps; step++) {
        let value = fma(fma(y + e2, y, e1), y, e0);
        let slope = fma(fma(3.0, y, 2.0 * e2), y, e1);
        let curvature = fma(6.0, y, 2.0 * e2);
        let root = sqrt(max(fma(4.0 * slope, slope, -6.0 * value * curvature), 0.0));
        // Left of the root the sum is at least y^2, which stays above 1e-8.
        y = min(y - 3.0 * value / max(slope + root, 1e-9), nearest_to_zero);
    }
    return hamburger6_polynomials(factor, fma(side, 1.0 / y, x)).weight;
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` >= 1e-7 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= C * 2^-24 * (1 + sensitivity) where fma is fused, with C = 32 for alpha
// of 1e-4 and more and C = 128 for alpha about 5e-6.
fn hamburger6_bounds(biased: SixMoments, fragment_depth: f32, alpha: f32) -> vec2f {
    let factor = hamburger6_factor(biased, alpha);
    let x = clamp(fragment_depth, -HAMBURGER6_FARTHEST_SUPPORT, HAMBURGER6_FARTHEST_SUPPORT) - biased.odd.x;
    let fragment = hamburger6_polynomials(factor, x);
    let below = hamburger6_nodes_below(fragment);
    if below == 0u {
        return vec2f(0.0, fragment.weight);
    }
    if below == 3u {
        return vec2f(1.0 - fragment.weight, 1.0);
    }
    let side = select(-1.0, 1.0, below == 1u);
    let weight = hamburger6_lone_weight(factor, x, fragment, side, alpha);
    let sum = weight + fragment.weight;
    return saturate(select(vec2f(1.0 - sum, 1.0 - weight), vec2f(weight, sum), below == 1u));
}

// The lower one of `hamburger6_bounds`, with fragment depths beyond the light's range counting as its ends.
fn hamburger6_lower_bound(biased: SixMoments, fragment_depth: f32, alpha: f32) -> f32 {
    return hamburger6_bounds(biased, clamp(fragment_depth, -1.0, 1.0), alpha).x;
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth) under the filtered moments
// of its map: the lower bound, never darker than the truth but for the bias. Moments lie within [-2, 2], as those from
// `six_moments_from_texels` do, valid or not; fragment depths beyond the light's range count as its ends.
fn hamburger6_shadow_intensity(moments: SixMoments, fragment_depth: f32, bias: SixMomentsBias) -> f32 {
    return hamburger6_lower_bound(six_moments_apply_bias(moments, bias), fragment_depth, bias.alpha);
}

// The same for the two filtered texels of a storage, with the bias of the storage.
fn hamburger6_shadow_intensity_of_texels(texels: array<vec4f, 2>, fragment_depth: f32, storage: u32) -> f32 {
    return hamburger6_shadow_intensity(six_moments_from_texels(texels, storage), fragment_depth, six_moments_bias_of(storage));
}

// moment_shadows/moments/enclosed_moments.wgsl

// Six moments of the occluders between the ends of a range, and apart from them how much lies before and behind it.
//
// In rectified coordinates much of a view ray has no occluder at all, or one that shadows every view ray of the frustum. As
// depths at the very ends of the range these take part in the moment problem, though it is known exactly what they do, and the
// bounds of everything else become looser by it. Six moments leave the fourth channel of both texels free, which is room for
// both weights. What is stored is linear in all of it and commutes with filtering and prefix sums.

// Sums over the occluders of a texel, each times its weight; all weights together are one.
struct EnclosedMoments {
    // Of those at depths between -1 and 1.
    moments: SixMoments,
    // Their weight.
    weight: f32,
    // The weight of those at -1 and before. What is left of one is behind the range: no occluder.
    front: f32,
}

// With less weight than this between the ends, where in between does not matter, and float16 has few digits left for it.
const ENCLOSED_MOMENTS_SMALLEST_WEIGHT: f32 = 0.001953125;

// Beyond this a moment bias leaves nothing of the moments.
const ENCLOSED_MOMENTS_LARGEST_ALPHA: f32 = 0.5;

// One occluder.
fn enclosed_moments_of_occluder(depth: f32, weight: f32) -> EnclosedMoments {
    let inner = select(0.0, weight, depth > -1.0 && depth < 1.0);
    let powers = six_moments_from_depth(clamp(depth, -1.0, 1.0));
    return EnclosedMoments(
        SixMoments(inner * powers.odd, inner * powers.even),
        inner,
        select(0.0, weight, depth <= -1.0),
    );
}

// Two occluders together.
fn enclosed_moments_sum(a: EnclosedMoments, b: EnclosedMoments) -> EnclosedMoments {
    let moments = SixMoments(a.moments.odd + b.moments.odd, a.moments.even + b.moments.even);
    return EnclosedMoments(moments, a.weight + b.weight, a.front + b.front);
}

// Three channels of the optimised basis times the weight, and one more.
fn enclosed_moments_texel(channels: vec3f, last: f32, weight: f32, storage: u32) -> vec4f {
    let middle = six_moments_middle(storage);
    let inside = saturate(weight);
    let texel = vec4f(clamp(channels, vec3f(-middle * inside), vec3f((1.0 - middle) * inside)), saturate(last));
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    return texel;
}

// What to write to the first texel of the storage: the odd moments, and what does not lie in front of the range. Moments of
// whole distributions, as `six_moments_to_odd_texel` has them, look the same.
fn enclosed_moments_to_odd_texel(sums: EnclosedMoments, storage: u32) -> vec4f {
    let offset = sums.weight * (SIX_MOMENTS_ODD_OFFSET - six_moments_middle(storage));
    let channels = six_moments_affine(SIX_MOMENTS_ODD_BASIS, sums.moments.odd, offset);
    return enclosed_moments_texel(channels, 1.0 - sums.front, sums.weight, storage);
}

// What to write to the second one: the even moments, and the weight between the ends.
fn enclosed_moments_to_even_texel(sums: EnclosedMoments, storage: u32) -> vec4f {
    let offset = sums.weight * (SIX_MOMENTS_EVEN_OFFSET - six_moments_middle(storage));
    let channels = six_moments_affine(SIX_MOMENTS_EVEN_BASIS, sums.moments.even, offset);
    return enclosed_moments_texel(channels, sums.weight, sums.weight, storage);
}

// The moments of a filtered texel's occluders between the ends, as means over them alone. Weights below
// `ENCLOSED_MOMENTS_SMALLEST_WEIGHT` count as that.
fn enclosed_moments_means(texels: array<vec4f, 2>, weight: f32, storage: u32) -> SixMoments {
    let middle = six_moments_middle(storage);
    let scale = 1.0 / max(weight, ENCLOSED_MOMENTS_SMALLEST_WEIGHT);
    let odd = clamp(scale * texels[0].xyz, vec3f(-middle), vec3f(1.0 - middle));
    let even = clamp(scale * texels[1].xyz, vec3f(-middle), vec3f(1.0 - middle));
    return SixMoments(
        six_moments_affine(SIX_MOMENTS_ODD_INVERSE, odd - (SIX_MOMENTS_ODD_OFFSET - middle), vec3f(0.0)),
        six_moments_affine(SIX_MOMENTS_EVEN_INVERSE, even - (SIX_MOMENTS_EVEN_OFFSET - middle), vec3f(0.0)),
    );
}

// The moment bias of means: that of the storage, which floats keep whatever the weight is, as they are finest around zero; the
// step of others is the same for small weights.
fn enclosed_moments_bias(weight: f32, storage: u32) -> SixMomentsBias {
    let bias = six_moments_bias_of(storage);
    let scale = select(1.0 / max(weight, ENCLOSED_MOMENTS_SMALLEST_WEIGHT), 1.0, storage_is_float(storage));
    return SixMomentsBias(bias.even, min(bias.alpha * scale, ENCLOSED_MOMENTS_LARGEST_ALPHA));
}

// Bounds of the shadow at a depth: x = how much of the weight is certainly before it, y = how much may be. Both in [0, 1] for all
// texels, filtered or broken; depths in [-1, 1].
fn enclosed_moments_bounds(filtered: array<vec4f, 2>, depth: f32, storage: u32) -> vec2f {
    let texels = array<vec4f, 2>(storage_finite_texel(filtered[0], storage), storage_finite_texel(filtered[1], storage));
    let weight = saturate(texels[1].w);
    let front = clamp(1.0 - texels[0].w, 0.0, 1.0 - weight);
    let bias = enclosed_moments_bias(weight, storage);
    let means = enclosed_moments_means(texels, weight, storage);
    let bounds = hamburger6_bounds(six_moments_apply_bias(means, bias), depth, bias.alpha);
    let known = weight >= ENCLOSED_MOMENTS_SMALLEST_WEIGHT;
    return fma(select(vec2f(0.0, 1.0), bounds, known), vec2f(weight), vec2f(front));
}

// scattering_bounds

// Both bounds of the shadow of a depth at a place of the integrated map, from a texel of each of its planes.
fn scattering_bounds(uv: vec2f, region: MapRegion, depth: f32) -> vec2f {
    let odd = moments_lookup(0u, region, uv, vec2f(0.0), vec2f(0.0));
    let even = moments_lookup(1u, region, uv, vec2f(0.0), vec2f(0.0));
    return enclosed_moments_bounds(array<vec4f, 2>(odd, even), depth, STORAGE);
}

// moment_shadows/air/phase_function.wgsl
// Phase functions: which part of the light that a medium scatters goes on per steradian of a direction.
//
// `cosine` is that of the angle between the directions of the light before and after; each integrates to 1 over the sphere.

// The same in all directions: 1 / (4 pi).
const PHASE_FUNCTION_ISOTROPIC: f32 = 0.07957747;

// The strongest anisotropy, where a lobe is still resolved in f32.
const PHASE_FUNCTION_LARGEST_ANISOTROPY: f32 = 0.99;

// Henyey & Greenstein, "Diffuse radiation in the galaxy", 1941: forwards for anisotropies above 0, backwards below, and
// isotropic to the bit at 0. `cosine` is in [-1, 1].
fn phase_function_henyey_greenstein(cosine: f32, anisotropy: f32) -> f32 {
    let g = clamp(anisotropy, -PHASE_FUNCTION_LARGEST_ANISOTROPY, PHASE_FUNCTION_LARGEST_ANISOTROPY);
    // (1 - g)^2 + 2 g (1 - cosine), each term as far from cancellation as the sign of g allows.
    let away = select(1.0 + cosine, 1.0 - cosine, g >= 0.0);
    let nearest = 1.0 - abs(g);
    let square = fma(2.0 * abs(g), max(away, 0.0), nearest * nearest);
    return PHASE_FUNCTION_ISOTROPIC * (1.0 - g * g) / (square * sqrt(square));
}

// moment_shadows/air/single_scattering.wgsl

// Light of a directional source that a homogeneous medium scatters once on its way along a view ray.
//
// Without shadows the radiance is a closed form of the ray's length, for each colour its own. Shadows enter as one number: the
// share of the ray's transmittance-weighted length that is shadowed, which prefix sums of moments in rectified coordinates
// bound for one lookup per pixel (Peters et al., JCGT 6(1) 2017, section 7).

// Filled by the host-side `SingleScattering`. All of it is at least 0 and finite, but for the anisotropy in [-1, 1].
struct SingleScattering {
    // Extinction per scene unit, by colour.
    extinction: vec3f,
    // Of the phase function of Henyey and Greenstein; 0 is isotropic, forwards is positive.
    anisotropy: f32,
    // Scattering per scene unit, by colour.
    scattering: vec3f,
    // The extinction that shadows are weighted with, the same for all colours.
    mean_extinction: f32,
    // Irradiance of a surface that faces the light.
    irradiance: vec3f,
    padding: f32,
}

// (1 - exp(-x)) / x for x >= 0; 1 at 0. The mean transmittance of a stretch of optical thickness x.
fn single_scattering_mean_transmittance(x: vec3f) -> vec3f {
    // Where the difference would cancel: its power series, with a remainder below 2^-23.
    var series = fma(x, vec3f(1.0 / 5040.0), vec3f(-1.0 / 720.0));
    series = fma(x, series, vec3f(1.0 / 120.0));
    series = fma(x, series, vec3f(-1.0 / 24.0));
    series = fma(x, series, vec3f(1.0 / 6.0));
    series = fma(x, series, vec3f(-0.5));
    series = fma(x, series, vec3f(1.0));
    let direct = (1.0 - exp(-x)) / max(x, vec3f(0.25));
    return select(direct, series, x < vec3f(0.5));
}

// The most radiance of a pixel: what float16 holds.
const SINGLE_SCATTERING_LARGEST: f32 = 65504.0;

// Transmittance of a stretch of the medium, by colour: what is left of the light behind it. 1 to the bit where nothing is
// extinguished.
fn single_scattering_transmittance(medium: SingleScattering, distance: f32) -> vec3f {
    let thickness = medium.extinction * distance;
    return select(exp(-thickness), vec3f(1.0), thickness <= vec3f(0.0));
}

// Radiance scattered into a view ray of some length of which a part is shadowed. `cosine` is that of the angle between the
// direction of the light and of the view ray, both as they travel away from light and camera.
fn single_scattering_radiance(medium: SingleScattering, distance: f32, cosine: f32, shadow: f32) -> vec3f {
    // Light that reaches the camera has turned from the light's direction to that against the view ray.
    let phase = phase_function_henyey_greenstein(-cosine, medium.anisotropy);
    let lit = phase * (1.0 - shadow) * distance;
    let thickness = max(medium.extinction * distance, vec3f(0.0));
    return lit * medium.irradiance * medium.scattering * single_scattering_mean_transmittance(thickness);
}

// What a pixel is given: radiance, and the mean of the colours' transmittance, which is 1 to the bit where all of them are.
// Where one of them is no finite number, since one of the parameters is none, there is no medium; less than no light is none.
fn single_scattering_pixel(radiance: vec3f, transmittance: vec3f) -> vec4f {
    let others = (transmittance.y - transmittance.x) + (transmittance.z - transmittance.x);
    let pixel = vec4f(radiance, fma(others, 1.0 / 3.0, transmittance.x));
    // By their bits: a compiler may assume that there is neither.
    let exponent = bitcast<vec4u>(pixel) & vec4u(0x7f800000u);
    let impossible = any(exponent == vec4u(0x7f800000u));
    let lit = clamp(pixel.xyz, vec3f(0.0), vec3f(SINGLE_SCATTERING_LARGEST));
    return select(vec4f(lit, saturate(pixel.w)), vec4f(0.0, 0.0, 0.0, 1.0), impossible);
}

// By which part of its distance from the near end of the range a view ray is moved there before it is compared with occluders.
const SINGLE_SCATTERING_DEPTH_BIAS: f32 = 0.05;

// The rectified depth in [-1, 1] at which a view ray is compared. A lit surface that the ray ends at is an occluder just behind it,
// ever nearer towards the ray's end; moments cannot tell it from one just before it, so that the air above lit ground would be too
// dark. Occluders at -1 stay in front of all view rays. The bias is fitted: with more of it light leaks behind casters near the
// ray, without any 16 steps of marching are better where little of what is seen is in shadow.
fn single_scattering_fragment_depth(depth: f32) -> f32 {
    return fma(-SINGLE_SCATTERING_DEPTH_BIAS, depth + 1.0, depth);
}

// The shadow that is shown, between its bounds (x <= y): overestimation that adapts to the direction. Where a view ray runs
// with the light it leans to the lower bound, whose light leaks into shadow; against it to the upper one, whose error is
// darkness (GDC 2016, where the weight of the lower bound is beta; the supplement of i3D 2016 calls its complement so). Both
// sources go all the way; here `overestimation` says how strongly, x against the light and y with it, each in [0, 1]. With 0 it
// is the middle of the bounds, which is too dark looking away from the light.
fn single_scattering_shadow(bounds: vec2f, cosine: f32, overestimation: vec2f) -> f32 {
    let strength = select(overestimation.x, overestimation.y, cosine > 0.0);
    return mix(bounds.y, bounds.x, saturate(fma(0.5 * strength, cosine, 0.5)));
}

// composite_scattering.wgsl

// In-scattered radiance of every pixel from the camera's depth and the integrated map, to be added to the picture behind the
// medium, which is first multiplied by the transmittance.

struct CompositeScatteringParameters {
    frame: RectifiedFrame,
    medium: SingleScattering,
}

@group(GROUP) @binding(0) var<uniform> parameters: CompositeScatteringParameters;
@group(GROUP) @binding(1) var camera_depth: texture_depth_2d;

@fragment
fn composite(covered: Covered) -> @location(0) vec4f {
    let picture = vec2i(textureDimensions(camera_depth));
    let pixel = clamp(vec2i(covered.uv * vec2f(picture)), vec2i(0), picture - 1);
    let uv = (vec2f(pixel) + 0.5) / vec2f(picture);
    let device = vec2f(2.0, -2.0) * uv + vec2f(-1.0, 1.0);
    let surface = rectified_frame_surface(parameters.frame, device, textureLoad(camera_depth, pixel, 0));
    let coordinates = rectified_frame_coordinates(surface);
    let distance = length(surface);
    let cosine = clamp(surface.z / max(distance, 1e-30), -1.0, 1.0);

    let size = textureDimensions(moments_map);
    let texels = vec2f(size);
    let place = rectified_frame_place(parameters.frame, coordinates);
    let map_uv = vec2f(rectified_frame_prefix(place.x, texels.x), rectified_frame_row(place.y, texels.y));
    let depth = single_scattering_fragment_depth(rectified_frame_depth(parameters.frame, coordinates.z));
    let bounds = scattering_bounds(map_uv, MapRegion(vec2u(0u), size), depth);
    let shadow = single_scattering_shadow(bounds, cosine, OVERESTIMATION);

    let radiance = single_scattering_radiance(parameters.medium, distance, cosine, shadow);
    let transmittance = single_scattering_transmittance(parameters.medium, distance);
    return single_scattering_pixel(radiance, transmittance);
}
