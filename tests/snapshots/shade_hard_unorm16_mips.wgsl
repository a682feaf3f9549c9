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

// moment_shadows/map/depth.wgsl
// Moment depth: the one interval that all moment arithmetic uses.
//
// Moment depth z is in [-1, 1], -1 at the light's near end and 1 at its far end, linear in distance along the light's
// axis. Signed depth needs a far smaller moment bias than depth in [0, 1] (Peters et al., JCGT 6(1) 2017, section 3).
// Every way in which a host stores depth (forward or reversed, orthographic or perspective, finite or infinite far
// plane, linear distance) is a ratio of two functions that are linear in the stored value, so one conversion serves all.

// How stored depth becomes moment depth. Filled by the host-side `DepthConversion`.
//
// With d = clamp(scale * stored + offset, 0, 1) the moment depth is
//   ((1 - d) * numerator.x + d * numerator.y) / ((1 - d) * denominator.x + d * denominator.y).
// Weighting the ends by 1 - d and d keeps both sums free of cancellation: a light with a near/far ratio of 1e5 in
// reversed float depth keeps its precision. The denominators are not negative, and not both zero.
struct DepthConversion {
    numerator: vec2f,
    denominator: vec2f,
    scale: f32,
    offset: f32,
    // Keeps the size a multiple of 16, as uniform buffers ask for arrays of it.
    padding: vec2f,
}

// The smallest denominator: the far end of an infinite projection divides by zero.
const DEPTH_SMALLEST_DENOMINATOR: f32 = 1e-30;

// The moment depth of a light with parallel rays.
const DEPTH_INFINITELY_FAR: f32 = -1e30;

// Whether `value` is NaN, by its bits: WGSL lets a compiler assume that no NaN occurs, so `value != value` may be folded.
fn depth_is_nan(value: f32) -> bool {
    return (bitcast<u32>(value) & 0x7fffffffu) > 0x7f800000u;
}

// Moment depth in [-1, 1] of a stored depth. NaN counts as the far end (no caster), infinities and values out of
// range as the nearer end of the interval.
fn depth_to_moment_depth(stored: f32, conversion: DepthConversion) -> f32 {
    let d = clamp(fma(clamp(stored, -3e38, 3e38), conversion.scale, conversion.offset), 0.0, 1.0);
    let ends = vec2f(1.0 - d, d);
    let ratio = dot(ends, conversion.numerator) / max(dot(ends, conversion.denominator), DEPTH_SMALLEST_DENOMINATOR);
    return select(clamp(ratio, -1.0, 1.0), 1.0, depth_is_nan(stored));
}

// The depth of a fragment in [-1, 1]: beyond the light's range it counts as the nearer end, and NaN as the near end, where
// every lower bound is 0.
fn depth_of_fragment(fragment_depth: f32) -> f32 {
    return select(clamp(fragment_depth, -1.0, 1.0), -1.0, depth_is_nan(fragment_depth));
}

// The stored depth of a moment depth: the inverse of the above, as the reference value of a comparison sampler. Moment
// depths that the stored interval does not reach count as its nearer end, NaN as the far end.
fn depth_from_moment_depth(moment_depth: f32, conversion: DepthConversion) -> f32 {
    let z = select(clamp(moment_depth, -1.0, 1.0), 1.0, depth_is_nan(moment_depth));
    let numerator = conversion.numerator;
    let denominator = conversion.denominator;
    // The weights d and 1 - d of the two ends, up to a factor that is positive where depth is stored from near to far.
    let weights = vec2f(fma(z, denominator.x, -numerator.x), fma(-z, denominator.y, numerator.y));
    let reversed = numerator.y * denominator.x < numerator.x * denominator.y;
    let positive = max(select(weights, -weights, reversed), vec2f(0.0));
    let d = positive.x / max(positive.x + positive.y, DEPTH_SMALLEST_DENOMINATOR);
    let scale = select(max(conversion.scale, DEPTH_SMALLEST_DENOMINATOR), min(conversion.scale, -DEPTH_SMALLEST_DENOMINATOR), conversion.scale < 0.0);
    return clamp((d - conversion.offset) / scale, -3e38, 3e38);
}

// The moment depth of a light's own place, below -1; DEPTH_INFINITELY_FAR where the stored depth is linear, as parallel rays
// have it.
fn depth_of_light(conversion: DepthConversion) -> f32 {
    // A perspective conversion tends to it where d grows without bounds.
    let divisor = conversion.denominator.y - conversion.denominator.x;
    if abs(divisor) < DEPTH_SMALLEST_DENOMINATOR {
        return DEPTH_INFINITELY_FAR;
    }
    return clamp((conversion.numerator.y - conversion.numerator.x) / divisor, DEPTH_INFINITELY_FAR, -1.0);
}

// moment_shadows/shade/leak_reduction.wgsl
// Light leaking, reduced after the bound: none of this touches the moments.
//
// Multiplying the moments by a constant before solving ("moment scale" in some samples) is not offered: it makes the
// total weight differ from one, so that the result bounds nothing.

// Filled by the host-side `LeakReduction`.
struct LeakReduction {
    // Shadow intensity that counts as full shadow, in (0, 1]; 0.98 hides weak leaks (Peters, GDC 2016).
    full_shadow: f32,
    // Visibility that counts as none, in [0, 1) (light bleeding reduction; Lauritzen, thesis 2008, section 3.4).
    bleed_reduction: f32,
    // Exponent of visibility, > 0; above 1 darkens penumbrae.
    visibility_exponent: f32,
    padding: f32,
}

// Shadow intensity after division by `full_shadow`.
fn leak_reduction_full_shadow(shadow_intensity: f32, full_shadow: f32) -> f32 {
    return saturate(shadow_intensity / max(full_shadow, 1e-6));
}

// Shadow intensity in [0, 1] after all three reductions. Each only darkens; full light stays full light.
fn leak_reduction_apply(shadow_intensity: f32, reduction: LeakReduction) -> f32 {
    let visibility = 1.0 - leak_reduction_full_shadow(clamp(shadow_intensity, 0.0, 1.0), reduction.full_shadow);
    let bleed = clamp(reduction.bleed_reduction, 0.0, 0.999);
    let remaining = saturate((visibility - bleed) / (1.0 - bleed));
    // pow(0, e) goes through the logarithm of 0, and e = 1 is to change nothing at all.
    let curved = pow(max(remaining, 1e-30), max(reduction.visibility_exponent, 1e-6));
    let plain = remaining <= 0.0 || reduction.visibility_exponent == 1.0;
    return 1.0 - select(curved, remaining, plain);
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

// moment_shadows/shade/area_light.wgsl
// Area lights: how wide a light appears on its map when a receiver sees it through a blocker.
//
// The light's outline, projected from the receiver through the blocker onto the map, is what a filter has to average for a
// penumbra (Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches). It is exact for one blocker parallel to the
// map. Filters of another shape than the light take one of the same variance, which makes penumbrae equally wide.

// Filled by the host-side `AreaLight`.
struct AreaLight {
    // Width and height of the light on the map in texels. Parallel rays: per scene unit between blocker and receiver. Rays
    // from a point: per 1 / scene unit of difference between their inverse distances.
    size: vec2f,
    // Distances from the light along its axis, in scene units, of the moment depths -1 and 1.
    near: f32,
    far: f32,
    // 0 for parallel rays, 1 for rays from a point.
    perspective: u32,
    // Smallest and largest half width in texels of filters. The smallest softens shadows near contacts; the largest bounds
    // noise and cost.
    smallest_radius: f32,
    largest_radius: f32,
    // 0 for a light that is a disk, 1 for a rectangle along the map's axes.
    rectangular: u32,
}

// The largest half width in texels.
const AREA_LIGHT_LARGEST_RADIUS: f32 = 4096.0;

// A box of half width h has the variance h^2 / 3 along an axis, a disk of radius r r^2 / 4: half widths of a box, of which
// the disk's radius is 1, and the reverse.
const AREA_LIGHT_BOX_OF_DISK: f32 = 0.8660254;
const AREA_LIGHT_DISK_OF_BOX: f32 = 1.1547005;

// Half the light's width and height in texels as a receiver sees it through a blocker, projected onto the map. Both depths
// are moment depths; 0 for a blocker that is not in front.
fn area_light_half_extent(light: AreaLight, blocker_depth: f32, receiver_depth: f32) -> vec2f {
    let ends = clamp(vec2f(blocker_depth, receiver_depth), vec2f(-1.0), vec2f(1.0));
    let distances = clamp(mix(vec2f(light.near), vec2f(light.far), 0.5 * ends + 0.5), vec2f(-1e15), vec2f(1e15));
    var apart = distances.y - distances.x;
    if light.perspective != 0u {
        // 1 / near - 1 / far as one quotient keeps its digits.
        let positive = max(distances, vec2f(1e-9));
        apart = apart / (positive.x * positive.y);
    }
    return 0.5 * clamp(light.size, vec2f(0.0), vec2f(1e15)) * clamp(apart, 0.0, 1e18);
}

// Half widths in texels between the light's smallest and largest one.
fn area_light_limited(light: AreaLight, half_extent: vec2f) -> vec2f {
    let smallest = vec2f(clamp(light.smallest_radius, 0.0, AREA_LIGHT_LARGEST_RADIUS));
    let largest = vec2f(clamp(light.largest_radius, 0.0, AREA_LIGHT_LARGEST_RADIUS));
    return min(max(half_extent, smallest), largest);
}

// The radii in texels of an elliptic filter that stands for the light.
fn area_light_disk(light: AreaLight, blocker_depth: f32, receiver_depth: f32) -> vec2f {
    let shape = select(1.0, AREA_LIGHT_DISK_OF_BOX, light.rectangular != 0u);
    return area_light_limited(light, shape * area_light_half_extent(light, blocker_depth, receiver_depth));
}

// The half widths in texels of a box filter that stands for the light.
fn area_light_box(light: AreaLight, blocker_depth: f32, receiver_depth: f32) -> vec2f {
    let shape = select(AREA_LIGHT_BOX_OF_DISK, 1.0, light.rectangular != 0u);
    return area_light_limited(light, shape * area_light_half_extent(light, blocker_depth, receiver_depth));
}

// moment_shadows/shade/receiver_bias.wgsl
// Receiver bias: how far the fragment depth moves towards the light so that a surface does not shadow itself.
//
// Not to be confused with the moment bias, which belongs to storage. A plane tilted against the light fills the filter
// kernel with depths whose standard deviation is
//   (the kernel's standard deviation in texels) x (change of depth per texel).
// The lower bound of four moments is exactly 0 for fragments in front of the lower Gauss node, which for a symmetric
// distribution lies one standard deviation in front of the mean. So a slope-scaled bias of somewhat more than one
// standard deviation removes self-shadowing on planes, and nothing about it has to be tuned to a scene.

// Standard deviations of depth under the filter by which a receiver moves: one, and what covers moment bias and rounding.
const RECEIVER_BIAS_STANDARD_DEVIATIONS: f32 = 1.25;

// A gradient steeper than any surface that a light sees; its square is still finite.
const RECEIVER_BIAS_EDGE_ON: f32 = 1e15;

// Filled by the host-side `ReceiverBias`.
struct ReceiverBias {
    // Moment depth that is always subtracted.
    constant: f32,
    // Multiplies the length of the gradient of moment depth per texel: the kernel's standard deviation in texels, times
    // a safety factor slightly above 1.
    slope_scale: f32,
    // The largest bias in moment depth; reached where the surface is seen edge-on by the light.
    maximum: f32,
    padding: f32,
}

// The gradient of moment depth per texel on the receiver's plane, from the differences of two neighbouring points on it
// in light space: xy in texels of the map, z in moment depth, each at most 1e9. Where the differences in xy are parallel
// or zero (the plane is edge-on to the light, or a neighbour is missing) the result is huge, and `receiver_bias_depth`
// limits it.
fn receiver_bias_plane(difference_x: vec3f, difference_y: vec3f) -> vec2f {
    let determinant = difference_x.x * difference_y.y - difference_x.y * difference_y.x;
    if abs(determinant) < 1e-20 {
        return vec2f(RECEIVER_BIAS_EDGE_ON, 0.0);
    }
    // Cramer's rule for the gradient g in dot(g, difference.xy) = difference.z.
    let scaled = vec2f(
        difference_x.z * difference_y.y - difference_y.z * difference_x.y,
        difference_y.z * difference_x.x - difference_x.z * difference_y.x,
    );
    return clamp(scaled / determinant, vec2f(-RECEIVER_BIAS_EDGE_ON), vec2f(RECEIVER_BIAS_EDGE_ON));
}

// The receiver bias in moment depth, to be subtracted from the fragment depth.
fn receiver_bias_depth(bias: ReceiverBias, gradient: f32) -> f32 {
    return clamp(fma(bias.slope_scale, gradient, bias.constant), 0.0, bias.maximum);
}

// The receiver bias where a lookup averages more of the map than its filter kernel: `variance` is the variance that this
// adds to the depths of a plane with that gradient (`minification_depth_variance`). Variances of filters add up.
fn receiver_bias_depth_minified(bias: ReceiverBias, gradient: f32, variance: f32) -> f32 {
    let kernel = bias.slope_scale * gradient;
    let added = RECEIVER_BIAS_STANDARD_DEVIATIONS * sqrt(max(variance, 0.0));
    let deviation = length(vec2f(kernel, added));
    // The limit is one of slope, not of depth: a filter that is wider by a factor may move by that factor more.
    let limit = (bias.maximum - bias.constant) * deviation / max(kernel, 1e-30);
    return max(bias.constant + min(deviation, max(limit, 0.0)), 0.0);
}

// The part of the bias that grows with the slope, under a kernel with the standard deviation `deviation` in texels along x
// and y, on a plane with the gradient of moment depth per texel; that counts up to the length `steepest`.
fn receiver_bias_depth_of_kernel(gradient: vec2f, deviation: vec2f, steepest: f32) -> f32 {
    let full = clamp(gradient, vec2f(-RECEIVER_BIAS_EDGE_ON), vec2f(RECEIVER_BIAS_EDGE_ON));
    let steepness = length(full);
    let limited = full * min(max(steepest, 0.0) / max(steepness, 1e-30), 1.0);
    return RECEIVER_BIAS_STANDARD_DEVIATIONS * length(limited * deviation);
}

// specialization
const GROUP = 0;
const LEVELS = 4u;
const VIEWS = 1u;
const LIGHTS = 1u;
const ANISOTROPY = 8.0;
const PLANES = 1u;
const STORAGE = 0u;

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

// moment_shadows/moments/four_moments.wgsl

// Four moments of depth: encoding, storage, bias.
//
// A texel holds b = (E[z], E[z^2], E[z^3], E[z^4]) of the moment depths z in [-1, 1] that it covers (Peters & Klein,
// "Moment Shadow Mapping", i3D 2015, section 2). Linear filters keep moments valid as long as their weights are not
// negative and sum to one. Storage with few bits holds an affine image of the moments that spreads them over the range
// of every channel (Peters, GDC 2016; JCGT 6(1) 2017, section 3); affine maps commute with filtering.

// A moment bias: b is moved by alpha towards (0, second, 0, fourth), which pulls moments that rounding has made
// impossible back among the possible ones. With one number beta for both these are the moments of occluders at the near
// end, the middle and the far end with the weights beta/2, 1 - beta and beta/2.
struct FourMomentsBias {
    alpha: f32,
    second: f32,
    fourth: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions (found by search: `moment-shadows bias`). Sums of many texels
// in f32 are off by more than the bias of float32 covers, unless they are made as in `split_sum`. The target is optimal for the basis and for distributions on the real line (JCGT 6(1) 2017, section 3).
const FOUR_MOMENTS_BIAS_UNORM16: FourMomentsBias = FourMomentsBias(6e-5, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT16: FourMomentsBias = FourMomentsBias(1e-3, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT32: FourMomentsBias = FourMomentsBias(1.5e-6, 0.375, 0.375);

// sqrt(3), which the optimised basis and its inverse are made of.
const FOUR_MOMENTS_SQRT_3: f32 = 1.7320508075688772;

// The moments of a single depth z in [-1, 1]: its powers (i3D 2015, equation 2).
fn four_moments_from_depth(z: f32) -> vec4f {
    let square = z * z;
    return vec4f(z, square, z * square, square * square);
}

// The optimised basis of JCGT 6(1) 2017 (equation 5, GDC 2016): maps the moments of depths in [-1, 1] into [0, 1]^4.
fn four_moments_quantize(b: vec4f) -> vec4f {
    return vec4f(
        fma(1.5, b.x, fma(-2.0, b.z, 0.5)),
        4.0 * (b.y - b.w),
        fma(0.5 * FOUR_MOMENTS_SQRT_3, b.x, fma(-2.0 / 9.0 * FOUR_MOMENTS_SQRT_3, b.z, 0.5)),
        0.5 * (b.y + b.w),
    );
}

// Inverse of `four_moments_quantize`. Channels in [0, 1] give |b| <= 2.1, whatever they hold.
fn four_moments_dequantize(channels: vec4f) -> vec4f {
    let odd = channels.xz - 0.5;
    return vec4f(
        fma(-1.0 / 3.0, odd.x, FOUR_MOMENTS_SQRT_3 * odd.y),
        fma(0.125, channels.y, channels.w),
        0.75 * fma(FOUR_MOMENTS_SQRT_3, odd.y, -odd.x),
        fma(-0.125, channels.y, channels.w),
    );
}

// Moments that certainly lie in their ranges: odd ones in [-1, 1], even ones in [0, 1]. Float storage can hold
// anything, and finite values beyond 1e15 would overflow further on.
fn four_moments_clamp(b: vec4f) -> vec4f {
    return clamp(b, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// What to write to a texel of the storage.
fn four_moments_to_texel(b: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return b;
    }
    let channels = saturate(four_moments_quantize(b));
    if storage == STORAGE_FLOAT16 {
        // Half precision is finest around zero, so the channels are centred there.
        return storage_round_to_float16(channels - 0.5);
    }
    return channels;
}

// The moments in a (filtered) texel of the storage. Float storage can hold anything; `four_moments_clamp` comes before any
// arithmetic that relies on ranges.
fn four_moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return texel;
    }
    if storage == STORAGE_FLOAT16 {
        return four_moments_dequantize(texel + 0.5);
    }
    return four_moments_dequantize(texel);
}

// The moment bias of a storage.
fn four_moments_bias_of(storage: u32) -> FourMomentsBias {
    if storage == STORAGE_FLOAT32 {
        return FOUR_MOMENTS_BIAS_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return FOUR_MOMENTS_BIAS_FLOAT16;
    }
    return FOUR_MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn four_moments_apply_bias(b: vec4f, bias: FourMomentsBias) -> vec4f {
    return fma(vec4f(bias.alpha), vec4f(0.0, bias.second, 0.0, bias.fourth) - b, b);
}

// The biased moments in a (filtered) texel of the storage, within [-2.1, 2.1]: for unorm storage if the channels are in
// [0, 1], as no texture can help, and for float storage whatever finite numbers it holds.
fn four_moments_biased_from_texel(texel: vec4f, storage: u32, bias: FourMomentsBias) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return four_moments_apply_bias(four_moments_clamp(texel), bias);
    }
    // The inverse of the basis and the bias are both affine, and so one step. These biases are large enough for 1 - alpha.
    let keep = 1.0 - bias.alpha;
    let of_xy = keep * vec4f(-1.0 / 3.0, 0.125, -0.75, -0.125);
    let of_zw = keep * vec4f(FOUR_MOMENTS_SQRT_3, 1.0, 0.75 * FOUR_MOMENTS_SQRT_3, 1.0);
    // Odd moments are 0 for channels of one half, and float16 storage holds one half less.
    let middle = select(vec4f(-0.5, 0.0, -0.5, 0.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
    let shift = fma(middle, of_xy + of_zw, bias.alpha * vec4f(0.0, bias.second, 0.0, bias.fourth));
    let biased = fma(of_xy, texel.xyxy, fma(of_zw, texel.zwzw, shift));
    if storage == STORAGE_FLOAT16 {
        return four_moments_clamp(biased);
    }
    return biased;
}

// moment_shadows/bounds/hamburger4.wgsl

// Hamburger four-moment shadow mapping: the sharpest bounds on shadow intensity that four moments allow.
//
// Among all distributions on the real line with the given moments, the share of depth in front of the fragment is
// smallest and largest for the canonical distribution that has the fragment depth and two more points as its support
// (Peters & Klein, i3D 2015, Proposition 3 and Algorithm 3). The published evaluation divides by a coefficient that
// vanishes when the fragment is at a Gauss node and takes the root of a difference that rounds below zero. This one
// gives the same values without either:
//   - the weight of a support point is its Christoffel number, a sum of positive terms;
//   - support points interlace with the Gauss nodes, so the sign of P2 tells on which side of the fragment they lie;
//   - where both sides have one, the discriminant of their quadratic is a sum of positive terms.

// Support points farther than this from the mean have a weight below 1e-8, and squaring them must not overflow.
const HAMBURGER4_FARTHEST_SUPPORT: f32 = 1e4;

// The leading coefficient stays above this, so that dividing by it is defined when the fragment is at a Gauss node.
const HAMBURGER4_SMALLEST_LEADING_COEFFICIENT: f32 = 1e-20;

// The two support points besides the fragment, relative to the mean, for a fragment at x = z - b1.
struct Hamburger4Support {
    // x_1 < x < x_2 if the fragment is between the Gauss nodes. Elsewhere finite; x_1 is then the farthest point where
    // x < 0, and without meaning where x > 0.
    points: vec2f,
    // Outside the Gauss nodes: whether x > 0.
    above: bool,
}

// The support of the extremal distribution through the fragment at x, where P2(x) is `second_polynomial`.
fn hamburger4_support(factor: HankelFactor, x: f32, second_polynomial: f32) -> Hamburger4Support {
    // -a y^2 + b y + c / 4 = 0 with a, c > 0, so both roots are real and 0 lies between them.
    let a = max(-second_polynomial, HAMBURGER4_SMALLEST_LEADING_COEFFICIENT);
    let b = fma(factor.ratio, x, factor.shift * a);
    let c = 4.0 * fma(factor.variance, a, factor.residue);
    // The roots' magnitudes are sum / (2 a) and c / (2 sum); the greater one has the sign of b. No term cancels.
    let sum = abs(b) + sqrt(fma(a, c, b * b));
    let above = b >= 0.0;
    let lower = select(sum, c, above) / select(a, sum, above);
    let upper = select(c, sum, above) / select(sum, a, above);
    let doubled = vec2f(
        max(-lower, -2.0 * HAMBURGER4_FARTHEST_SUPPORT),
        min(upper, 2.0 * HAMBURGER4_FARTHEST_SUPPORT),
    );
    return Hamburger4Support(0.5 * doubled, above);
}

// Both bounds for a fragment at x = z - b1, where P2(x) is `polynomial`.
fn hamburger4_bounds_at(factor: HankelFactor, x: f32, polynomial: f32) -> vec2f {
    if polynomial >= 0.0 {
        // Outside the Gauss nodes no support point lies beyond the fragment: no root is needed.
        let weight = saturate(hankel_christoffel_number(factor, x, polynomial));
        return select(vec2f(0.0, weight), vec2f(1.0 - weight, 1.0), x > 0.0);
    }
    let support = hamburger4_support(factor, x, polynomial).points;
    let below = hankel_christoffel_number(factor, support.x, hankel_second_polynomial(factor, support.x));
    let above = hankel_christoffel_number(factor, support.y, hankel_second_polynomial(factor, support.y));
    return saturate(vec2f(below, 1.0 - above));
}

// The lower one of them; where it is 0 the result is below 1e-8.
fn hamburger4_lower_bound_at(factor: HankelFactor, x: f32, polynomial: f32) -> f32 {
    let support = hamburger4_support(factor, x, polynomial);
    // One Christoffel number serves all cases: at the fragment itself where it is above the Gauss nodes, or else at the
    // support point below it. Where the fragment is below the Gauss nodes that one is at infinity, without weight.
    let beyond = polynomial >= 0.0 && support.above;
    let t = select(support.points.x, x, beyond);
    let weight = saturate(hankel_christoffel_number(factor, t, hankel_second_polynomial(factor, t)));
    return select(weight, 1.0 - weight, beyond);
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` >= 1e-7 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= 8 * 2^-24 * (1 + sensitivity) where fma is fused.
fn hamburger4_bounds(biased: vec4f, fragment_depth: f32, alpha: f32) -> vec2f {
    let factor = hankel_factor(biased, alpha);
    let x = clamp(fragment_depth, -HAMBURGER4_FARTHEST_SUPPORT, HAMBURGER4_FARTHEST_SUPPORT) - biased.x;
    return hamburger4_bounds_at(factor, x, hankel_second_polynomial(factor, x));
}

// The lower one of `hamburger4_bounds`, with fragment depths beyond the light's range counting as its ends; where the
// bound is 0 the result is below 1e-8.
fn hamburger4_lower_bound(biased: vec4f, fragment_depth: f32, alpha: f32) -> f32 {
    let factor = hankel_factor(biased, alpha);
    let x = clamp(fragment_depth, -1.0, 1.0) - biased.x;
    return hamburger4_lower_bound_at(factor, x, hankel_second_polynomial(factor, x));
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth) under the filtered moments
// of its map: the lower bound, never darker than the truth but for the bias. Moments may be anything finite; fragment
// depths beyond the light's range count as its ends.
fn hamburger4_shadow_intensity(moments: vec4f, fragment_depth: f32, bias: FourMomentsBias) -> f32 {
    return hamburger4_lower_bound(four_moments_apply_bias(four_moments_clamp(moments), bias), fragment_depth, bias.alpha);
}

// The same for a filtered texel of a storage, with the bias of the storage. Cheaper, since decoding and bias are one step
// and a texel of unorm storage needs no clamping.
fn hamburger4_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, storage: u32) -> f32 {
    let bias = four_moments_bias_of(storage);
    return hamburger4_lower_bound(four_moments_biased_from_texel(texel, storage, bias), fragment_depth, bias.alpha);
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

// moments_lookup

// The lookup in a map with mip levels that the device can filter.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var anisotropic_sampler: sampler;

// The texel at `uv` in [0, 1] across a region, filtered over a pixel with these differences of place to its neighbours.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    return map_lookup_gradient(moments_map, anisotropic_sampler, layer, region, LEVELS, uv, difference_x, difference_y, ANISOTROPY);
}

// technique_receiver

// What a technique is told about a surface that a view of a light contains.

struct TechniqueReceiver {
    // The map's layer, and the region with texels.
    layer: u32,
    region: MapRegion,
    // The place from 0 to 1 across the region, and how it changes, in texels, to the pixels beside and below.
    uv: vec2f,
    difference_x: vec2f,
    difference_y: vec2f,
    // The gradient of moment depth per texel on the surface.
    gradient: vec2f,
    // Moment depth: less the receiver bias, and less what depths are rounded by alone.
    fragment_depth: f32,
    depth: f32,
    // The steepest slope per texel that is no edge.
    steepest: f32,
    // How the light's map stores depth, and the light's size: for tests on the plain depth map.
    conversion: DepthConversion,
    light: AreaLight,
    // The pixel's coordinates.
    pixel: vec2f,
}

// map_texel

// The filtered texel of a plane of the map at a receiver.
fn map_texel(receiver: TechniqueReceiver, plane: u32) -> vec4f {
    return moments_lookup(receiver.layer * PLANES + plane, receiver.region, receiver.uv, receiver.difference_x, receiver.difference_y);
}

// technique

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return hamburger4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}

// technique_map

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(moments_map);
}

// shade.wgsl

// Shadow intensity of every pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target.

struct ViewParameters {
    // From the camera's clip space (x, y, stored depth, 1) to the light: x and y are the place in the map in [0, 1], z its
    // homogeneous coordinate (positive in front of the light) and w the moment depth, all times the factors they are
    // divided by. Camera and light are combined in one matrix so that no large scene coordinates occur.
    light_from_camera: mat4x4f,
    // The homogeneous coordinate of the scene position, which divides the moment depth.
    scene_w_from_camera: vec4f,
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // Where the view lies in its layer; without texels there is no such view.
    region: MapRegion,
    // The stored depth of pixels that show no surface; the same for all views.
    far_depth: f32,
    // The map's layer.
    layer: u32,
    // The target's channel, 0 to 3. Of the views of one channel the first that contains a pixel shades it.
    channel: u32,
    padding: f32,
    // How the light's map stores depth, and how large the light is: for tests on the plain depth map.
    conversion: DepthConversion,
    light: AreaLight,
}

@group(GROUP) @binding(0) var<uniform> views: array<ViewParameters, VIEWS>;
@group(GROUP) @binding(1) var camera_depth: texture_depth_2d;

// A pixel's surface as the light sees it.
struct Receiver {
    // x and y in the map from 0 to 1, z in moment depth.
    place: vec3f,
    // What x and y were divided by; positive in front of the light.
    light_w: f32,
    // What z was divided by; positive in front of the camera.
    scene_w: f32,
}

fn receiver_at(view: u32, pixel: vec2i, stored_depth: f32) -> Receiver {
    let uv = (vec2f(pixel) + 0.5) / vec2f(textureDimensions(camera_depth));
    let clip = vec4f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, stored_depth, 1.0);
    let light = views[view].light_from_camera * clip;
    // Results behind the camera or the light are not used.
    let scene_w = max(dot(views[view].scene_w_from_camera, clip), 1e-30);
    return Receiver(vec3f(light.xy / max(light.z, 1e-30), light.w / scene_w), light.z, scene_w);
}

fn camera_depth_at(pixel: vec2i) -> f32 {
    return textureLoad(camera_depth, clamp(pixel, vec2i(0), vec2i(textureDimensions(camera_depth)) - 1), 0);
}

// By how much the two pixels next to `pixel` along `step`, extrapolated, miss its stored depth; huge if the first one
// shows no surface or lies outside of the picture.
fn extrapolation_error(pixel: vec2i, step: vec2i, stored_depth: f32) -> f32 {
    let neighbour = pixel + step;
    let outside = any(neighbour < vec2i(0)) || any(neighbour >= vec2i(textureDimensions(camera_depth)));
    let depth = camera_depth_at(neighbour);
    let error = abs(2.0 * depth - camera_depth_at(neighbour + step) - stored_depth);
    return select(error, UNUSABLE, outside || depth == views[0].far_depth);
}

// Above every difference of stored depths.
const UNUSABLE: f32 = 1e30;

// No place in the map is that many texels away. Products of two differences must not overflow.
const LARGEST_DIFFERENCE: f32 = 1e9;

// The neighbour of a pixel along `axis` on the side that continues its surface: xy is the step to it and z the change of
// stored depth. Stored depth is linear on the screen where a surface is plane, so that is the side which extrapolates to
// the pixel best; the other one may lie beyond a silhouette or an edge. Zero if there is no neighbour.
fn neighbour_of(pixel: vec2i, axis: vec2i, stored_depth: f32) -> vec3f {
    let error_before = extrapolation_error(pixel, -axis, stored_depth);
    let error_after = extrapolation_error(pixel, axis, stored_depth);
    if min(error_before, error_after) == UNUSABLE {
        return vec3f(0.0);
    }
    let direction = select(axis, -axis, error_before < error_after);
    return vec3f(vec2f(direction), camera_depth_at(pixel + direction) - stored_depth);
}

// How the place in the map (in texels) and the moment depth change from a pixel to its neighbour; zero if there is none,
// as on a surface that is edge-on to the light.
fn receiver_difference(view: u32, neighbour: vec3f, receiver: Receiver, texels: vec2f) -> vec3f {
    if all(neighbour.xy == vec2f(0.0)) {
        return vec3f(0.0);
    }
    let across_screen = vec2f(2.0, -2.0) * neighbour.xy / vec2f(textureDimensions(camera_depth));
    let step = vec4f(across_screen, neighbour.z, 0.0);
    // With numerators n and divisors w, n1 / w1 - n0 / w0 = (dn - (n0 / w0) dw) / w1. Other than the difference of two
    // places, this keeps its digits where a pixel covers a small part of a texel.
    let light = views[view].light_from_camera * step;
    let scene_w = dot(views[view].scene_w_from_camera, step);
    let across = (light.xy - receiver.place.xy * light.z) / max(receiver.light_w + light.z, 1e-30);
    let along = (light.w - receiver.place.z * scene_w) / max(receiver.scene_w + scene_w, 1e-30);
    return clamp(vec3f(across * texels, along), vec3f(-LARGEST_DIFFERENCE), vec3f(LARGEST_DIFFERENCE));
}

// Shadow intensity of a receiver that a view contains.
fn view_shadow_intensity(view: u32, pixel: vec2i, receiver: Receiver, neighbour_x: vec3f, neighbour_y: vec3f, region: MapRegion) -> f32 {
    let texels = vec2f(region.extent);
    let difference_x = receiver_difference(view, neighbour_x, receiver, texels);
    let difference_y = receiver_difference(view, neighbour_y, receiver, texels);
    let gradient = receiver_bias_plane(difference_x, difference_y);
    let settings = views[view].receiver_bias;
    var bias = receiver_bias_depth(settings, length(gradient));
    if LEVELS > 1u {
        let footprint = minification_footprint(difference_x.xy, difference_y.xy, ANISOTROPY);
        let variance = minification_depth_variance(footprint, gradient);
        bias = receiver_bias_depth_minified(settings, length(gradient), variance);
    }
    // The map holds a surface that leaves the light's range at the far end. The bias counts from there, since some of the
    // kernel may still see the surface within the range.
    let depth = min(receiver.place.z, 1.0);
    let intensity = technique_shadow_intensity(TechniqueReceiver(
        views[view].layer,
        region,
        receiver.place.xy,
        difference_x.xy,
        difference_y.xy,
        gradient,
        depth - bias,
        depth - settings.constant,
        (settings.maximum - settings.constant) / max(settings.slope_scale, 1e-30),
        views[view].conversion,
        views[view].light,
        vec2f(pixel),
    ));
    return leak_reduction_apply(intensity, views[view].leak_reduction);
}

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(camera_depth));
    let pixel = clamp(vec2i(covered.uv * vec2f(size)), vec2i(0), size - 1);
    let stored_depth = textureLoad(camera_depth, pixel, 0);
    // Outside its map a light casts no shadow, and where there is no surface, either.
    var intensities = vec4f(0.0);
    if stored_depth == views[0].far_depth {
        return intensities;
    }
    let neighbour_x = neighbour_of(pixel, vec2i(1, 0), stored_depth);
    let neighbour_y = neighbour_of(pixel, vec2i(0, 1), stored_depth);
    var open_channels = vec4<bool>(true);
    for (var view = 0u; view < VIEWS; view++) {
        let channel = vec4<bool>(vec4u(views[view].channel) == vec4u(0u, 1u, 2u, 3u));
        let region = map_region_within(views[view].region, technique_map_size());
        let receiver = receiver_at(view, pixel, stored_depth);
        let uv = receiver.place.xy;
        let inside = receiver.light_w > 0.0 && all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
        if inside && all(region.extent > vec2u(0u)) && any(channel & open_channels) {
            let intensity = view_shadow_intensity(view, pixel, receiver, neighbour_x, neighbour_y, region);
            intensities = select(intensities, vec4f(intensity), channel);
            open_channels = open_channels & !channel;
        }
    }
    // A single light is in all channels, so that a host can blend with it or show it.
    return select(intensities, intensities.xxxx, LIGHTS == 1u);
}
