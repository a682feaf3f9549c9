// Minification: what part of a map a pixel covers.
//
// A pixel maps to a parallelogram of texels. Its singular values are the axes of the ellipse that stands for it
// (Heckbert, "Fundamentals of Texture Mapping and Image Warping", 1989, section 3.5): a lookup takes probes along the
// major axis, each on the mip level that fits the minor axis. Averages of moments are moments, which is what filterable
// shadow maps exist for (Donnelly & Lauritzen, "Variance Shadow Maps", i3D 2006, section 3).

// Probes along the major axis, at most.
const MINIFICATION_LARGEST_ANISOTROPY: f32 = 16.0;

struct MinificationFootprint {
    // The major axis, from end to end, in texels of mip level 0; zero where a pixel covers no more than a texel.
    major: vec2f,
    // Probes along it, a whole number from 1 to 16.
    probes: f32,
    // The mip level of each probe, at least 0.
    level: f32,
}

// The footprint of a pixel from the differences of place, in texels, to its neighbours in x and y; each component at
// most 1e9 in magnitude. `anisotropy`, from 1 to 16, is the ratio of the axes up to which probes follow the major axis;
// beyond it the minor axis is taken for longer than it is.
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
    let width = max(max(minor_length, major_length / largest), 1.0);
    return MinificationFootprint(
        select(vec2f(0.0), unit * major_length, major_length > 1.0),
        clamp(ceil(major_length / width - 1e-3), 1.0, MINIFICATION_LARGEST_ANISOTROPY),
        log2(width),
    );
}

// Where probe `index` lies on the major axis: the offset, in texels, from the footprint's centre.
fn minification_probe(footprint: MinificationFootprint, index: f32) -> vec2f {
    return ((index + 0.5) / footprint.probes - 0.5) * footprint.major;
}

// The variance that minification adds to the moment depths of a plane, whose moment depth changes by `gradient` per texel.
//
// A trilinear lookup on level l averages boxes of 2^l texels, and blends neighbours that are 2^l texels apart: (1/12 +
// 1/6) 4^l. Between two levels their mixture has at most 1.13 times the variance of the level between them. The probes
// together add the variance of a box along the major axis.
fn minification_depth_variance(footprint: MinificationFootprint, gradient: vec2f) -> f32 {
    let width = select(0.0, exp2(footprint.level), footprint.level > 0.0);
    let across = width * length(gradient);
    let along = select(0.0, dot(footprint.major, gradient), footprint.probes > 1.0);
    return (1.13 / 4.0) * across * across + along * along / 12.0;
}
