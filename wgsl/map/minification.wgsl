// Minification: what part of a map a pixel covers.
//
// A pixel maps to a parallelogram of texels. Its singular values are the axes of the ellipse that stands for it
// (Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, section 3.5): a lookup takes probes along the
// major axis, each on a mip level that fits the minor axis. Averages of moments are moments, which is what filterable
// shadow maps exist for (Donnelly & Lauritzen, "Variance Shadow Maps", i3D 2006, section 3).
//
// A pixel averages a box: over w texels its variance is w^2 / 12. A trilinear lookup on a mip level whose texels are t wide
// averages boxes of t and blends neighbours that are t apart: (1/12 + 1/6) t^2. Lookups are as wide as pixels if their
// variances are equal, t = w / sqrt(3); a level with t = w, as is usual for colour textures, would filter three times as
// much.

// The largest number of probes along the major axis.
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

// The same as lengths, which is all that hardware has to be told.
struct MinificationAxes {
    // Along the major axis; zero for a circle, which has no direction.
    direction: vec2f,
    // The length of the line on which probes lie, and the width of their texels, at least 1, in texels of mip level 0.
    line: f32,
    texel: f32,
}

// The axes of a pixel from the differences of place, in texels, to its neighbours in x and y; each component at most 1e9
// in magnitude. `anisotropy`, from 1 to 16, is the largest number of probes; where more would be needed, the minor axis
// counts as longer than it is.
fn minification_axes(difference_x: vec2f, difference_y: vec2f, anisotropy: f32) -> MinificationAxes {
    let xx = difference_x.x * difference_x.x + difference_y.x * difference_y.x;
    let xy = difference_x.x * difference_x.y + difference_y.x * difference_y.y;
    let yy = difference_x.y * difference_x.y + difference_y.y * difference_y.y;
    // The squares of the axes are the eigenvalues of the symmetric matrix (xx xy, xy yy).
    let half_difference = 0.5 * (xx - yy);
    let root = sqrt(half_difference * half_difference + xy * xy);
    let major_square = 0.5 * (xx + yy) + root;
    let per_major = inverseSqrt(max(major_square, 1e-36));
    let major_length = major_square * per_major;
    // The product of the axes is the parallelogram's area; a difference of eigenvalues would cancel.
    let area = abs(difference_x.x * difference_y.y - difference_x.y * difference_y.x);
    let minor_length = area * per_major;
    // Both rows of the matrix less its smaller eigenvalue point along the major axis; this is the one that does not cancel.
    let along = select(vec2f(xy, root - half_difference), vec2f(root + half_difference, xy), half_difference >= 0.0);
    let direction = along * inverseSqrt(max(dot(along, along), 1e-36));
    let largest = clamp(anisotropy, 1.0, MINIFICATION_LARGEST_ANISOTROPY);
    // With so many probes a texel apart the major axis is filled: w^2 = 3 major_length^2 / (largest^2 + 2).
    let filled = major_length * sqrt(3.0 / fma(largest, largest, 2.0));
    let width = max(max(minor_length, filled), 1.0);
    // A probe has the variance of the width along the major axis, too: the line of probes is shorter by that.
    let line = sqrt(max(fma(-width, width, major_square), 0.0));
    return MinificationAxes(direction, line, max(width * MINIFICATION_TEXEL_PER_WIDTH, 1.0));
}

// The footprint of a pixel; arguments are those of `minification_axes`.
fn minification_footprint(difference_x: vec2f, difference_y: vec2f, anisotropy: f32) -> MinificationFootprint {
    let axes = minification_axes(difference_x, difference_y, anisotropy);
    let largest = clamp(anisotropy, 1.0, MINIFICATION_LARGEST_ANISOTROPY);
    let probes = clamp(ceil(axes.line / axes.texel - MINIFICATION_SLACK), 1.0, largest);
    return MinificationFootprint(axes.direction * axes.line, probes, log2(axes.texel));
}

// A line that is longer than a texel by less than this part of it needs no further probe.
const MINIFICATION_SLACK: f32 = 1e-3;

// Where probe `index` lies on the major axis: the offset, in texels, from the footprint's centre.
fn minification_probe(footprint: MinificationFootprint, index: f32) -> vec2f {
    return ((index + 0.5) / footprint.probes - 0.5) * footprint.major;
}

// The axes as the differences of place, in texels, that make a sampler with anisotropy take exactly the probes of a footprint: x is
// the column of the line, at least as long as the other one.
fn minification_axes_gradients(axes: MinificationAxes) -> mat2x2f {
    let direction = select(vec2f(1.0, 0.0), axes.direction, axes.line >= 1e-3);
    return mat2x2f(direction * max(axes.line, axes.texel), vec2f(-direction.y, direction.x) * axes.texel);
}

// The variance that minification adds to the moment depths of a plane, whose moment depth changes by `gradient` per texel:
// that of the probes' trilinear lookups, and that of the line they lie on. Between two levels the mixture of both has at
// most 1.27 times the variance of the level between them.
fn minification_axes_depth_variance(axes: MinificationAxes, gradient: vec2f) -> f32 {
    let texel = select(0.0, axes.texel, axes.texel > 1.0);
    let line = select(0.0, axes.line, axes.line > (1.0 + MINIFICATION_SLACK) * axes.texel);
    let along = line * dot(axes.direction, gradient);
    return fma((1.27 / 4.0) * texel * texel, dot(gradient, gradient), along * along / 12.0);
}

// The axes of a footprint.
fn minification_footprint_axes(footprint: MinificationFootprint) -> MinificationAxes {
    let length = length(footprint.major);
    let line = select(0.0, length, footprint.probes > 1.0);
    return MinificationAxes(footprint.major / max(length, 1e-6), line, exp2(footprint.level));
}

// `minification_axes_gradients` of a footprint.
fn minification_gradients(footprint: MinificationFootprint) -> mat2x2f {
    return minification_axes_gradients(minification_footprint_axes(footprint));
}

// `minification_axes_depth_variance` of a footprint.
fn minification_depth_variance(footprint: MinificationFootprint, gradient: vec2f) -> f32 {
    return minification_axes_depth_variance(minification_footprint_axes(footprint), gradient);
}
