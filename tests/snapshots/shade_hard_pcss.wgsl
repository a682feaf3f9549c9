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
const LEVELS = 1u;
const VIEWS = 1u;
const LIGHTS = 1u;
const ANISOTROPY = 8.0;
const PLANES = 1u;
const SEARCH_TAPS = 16u;
const FILTER_TAPS = 32u;

// moment_shadows/maths/disk_samples.wgsl
// Samples that are spread over the unit disk, and the rotation by which each pixel turns them.
//
// With few samples a filter makes bands; turned by another angle in each pixel it makes noise, which the eye and temporal
// filters forgive.

// How many samples the Poisson disk has.
const DISK_SAMPLES_POISSON_COUNT: u32 = 16u;

// A Poisson disk: no two samples are closer than 0.455. Sample i lies at radius sqrt((i + 0.5) / 16), in the middle of one
// of 16 rings of equal area, so that turned by every angle they cover the disk evenly. Their angles were found by best
// candidates and random relaxation of the smallest distance.
const DISK_SAMPLES_POISSON = array<vec2f, 16>(
    vec2f(0.027483, -0.174627),
    vec2f(0.059710, 0.300308),
    vec2f(-0.383554, 0.095584),
    vec2f(0.465980, 0.040162),
    vec2f(-0.389073, -0.360378),
    vec2f(0.415935, -0.413217),
    vec2f(-0.321242, 0.550503),
    vec2f(0.471743, 0.496194),
    vec2f(0.000066, -0.728869),
    vec2f(0.083704, 0.765992),
    vec2f(-0.806214, -0.079181),
    vec2f(-0.750352, 0.394616),
    vec2f(0.858217, -0.211455),
    vec2f(0.876628, 0.274358),
    vec2f(-0.520274, -0.797223),
    vec2f(0.435590, -0.882616),
);

// A full turn in radians.
const DISK_SAMPLES_TURN: f32 = 6.2831853;

// The angle between two neighbours of a sunflower's seeds: a full turn times (3 - sqrt(5)) / 2.
const DISK_SAMPLES_GOLDEN_ANGLE: f32 = 2.3999632;

// The angle in radians, from 0 to a full turn, by which a pixel turns its samples: interleaved gradient noise of its
// coordinates (Jimenez, "Next Generation Post Processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014). `pixel` from
// 0 to 65536.
fn disk_samples_angle(pixel: vec2f) -> f32 {
    return DISK_SAMPLES_TURN * fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

// Cosine and sine of an angle in radians, which `disk_samples_rotate` takes.
fn disk_samples_rotation(angle: f32) -> vec2f {
    // Devices need not know sines beyond a turn.
    let turned = DISK_SAMPLES_TURN * fract(angle / DISK_SAMPLES_TURN);
    return vec2f(cos(turned), sin(turned));
}

// A sample turned by a rotation.
fn disk_samples_rotate(sample: vec2f, rotation: vec2f) -> vec2f {
    return vec2f(dot(sample, vec2f(rotation.x, -rotation.y)), dot(sample, rotation.yx));
}

// Sample `index` of the Poisson disk, 0 to 15, turned.
fn disk_samples_poisson(index: u32, rotation: vec2f) -> vec2f {
    return disk_samples_rotate(DISK_SAMPLES_POISSON[min(index, DISK_SAMPLES_POISSON_COUNT - 1u)], rotation);
}

// Sample `index` of a disk of any number of samples, which cover it evenly (Vogel, "A better way to construct the
// sunflower head", Mathematical Biosciences 44, 1979), turned. `count` at least 1.
fn disk_samples_vogel(index: u32, count: u32, rotation: vec2f) -> vec2f {
    let radius = sqrt((f32(index) + 0.5) / f32(max(count, 1u)));
    return disk_samples_rotate(vec2f(radius, 0.0), disk_samples_rotate(disk_samples_rotation(f32(index) * DISK_SAMPLES_GOLDEN_ANGLE), rotation));
}

// moment_shadows/filter/gaussian.wgsl
// Gaussian filter weights, and the plain form of the separable filter.
//
// Filters of moments need weights that are not negative and sum to one; the Gaussian, cut off at a radius and
// normalised, is the one that the moment shadow mapping papers use (9 x 9 texels with sigma 2.4; i3D 2015, section 4).
// Render-graph nodes filter with blocks of texels held in registers; this form is for shaders of one's own, and is what
// those are compared with.

// Gaussian at `offset` texels from the centre, not normalised. `sigma` > 0 in texels; smaller values count as 1e-3.
fn gaussian_weight(offset: f32, sigma: f32) -> f32 {
    let ratio = offset / max(sigma, 1e-3);
    return exp(-0.5 * ratio * ratio);
}

// One direction of the separable filter at `texel`: 2 radius + 1 texels of mip 0 along `direction` ((1, 0) or (0, 1)),
// weighted and normalised. Beyond the border the last texel repeats. `radius` from 0 to 64.
fn gaussian_filter(map: texture_2d<f32>, texel: vec2i, direction: vec2i, radius: i32, sigma: f32) -> vec4f {
    let last = vec2i(textureDimensions(map)) - 1;
    let reach = clamp(radius, 0, 64);
    var sum = vec4f(0.0);
    var total = 0.0;
    for (var offset = -reach; offset <= reach; offset++) {
        let weight = gaussian_weight(f32(offset), sigma);
        sum = fma(vec4f(weight), textureLoad(map, clamp(texel + offset * direction, vec2i(0), last), 0), sum);
        total += weight;
    }
    // The centre's weight is 1, so the total is at least 1.
    return sum / total;
}

// moment_shadows/shade/receiver_plane.wgsl

// The plane of a receiver over a depth map: what each tap of a filter is compared with.
//
// A filter that compares every tap with the fragment's own depth counts half of a tilted receiver as its occluder. Comparing
// with the depth of the receiver's plane at the tap instead leaves what stands in front of that plane. For parallel rays
// moment depth on a plane is linear over the map. For rays from a point its distance from the light is the receiver's
// over a linear function.

// A receiver as a region of a depth map sees it.
struct ReceiverPlane {
    // Its place from 0 to 1 across the region.
    uv: vec2f,
    // The gradient of moment depth per texel there.
    gradient: vec2f,
    // Its moment depth.
    depth: f32,
    // 1 / the difference of moment depth between receiver and light; next to 0 for parallel rays.
    inverse_reach: f32,
}

// Above every gradient and depth that matters; products of it with distances in texels are finite.
const RECEIVER_PLANE_LARGEST: f32 = 1e15;

// The plane of a receiver. `uv` outside of [0, 1] counts as the nearer edge, a `depth` that is NaN as the far end.
// `gradient` is that of moment depth per texel (`receiver_bias_plane`); where it is longer than `steepest` the surface is
// edge-on to the light, or the neighbours belong to another one: it is shortened to that. `light_depth` is the moment
// depth of the light itself (`depth_of_light`), below -1: DEPTH_INFINITELY_FAR for parallel rays.
fn receiver_plane_through(uv: vec2f, depth: f32, gradient: vec2f, steepest: f32, light_depth: f32) -> ReceiverPlane {
    let z = select(clamp(depth, -1e6, 1e6), 1.0, depth_is_nan(depth));
    let full = clamp(gradient, vec2f(-RECEIVER_PLANE_LARGEST), vec2f(RECEIVER_PLANE_LARGEST));
    let limit = clamp(steepest, 0.0, RECEIVER_PLANE_LARGEST);
    let steepness = length(full);
    let limited = select(full, full * (limit / max(steepness, 1e-30)), steepness > limit);
    return ReceiverPlane(clamp(uv, vec2f(0.0), vec2f(1.0)), limited, z, 1.0 / max(z - light_depth, 1e-6));
}

// A plane moved by `bias` in moment depth towards the light, as a whole: its distances from a light with rays from a point
// all shrink by the same factor. One through the biased depth with the unbiased gradient would be too steep, and cross the
// receiver's own where that recedes. `bias` is less than the distance from the light.
fn receiver_plane_biased(plane: ReceiverPlane, bias: f32) -> ReceiverPlane {
    let towards = clamp(bias, -4.0, 4.0);
    let shrunk = clamp(1.0 - towards * plane.inverse_reach, 1e-6, 1e7);
    return ReceiverPlane(plane.uv, plane.gradient * shrunk, plane.depth - towards, plane.inverse_reach / shrunk);
}

// The moment depth in [-1, 1] of the plane at `offset` texels from the receiver. It ends at the far end, which texels without a
// caster hold: they never shadow.
fn receiver_plane_depth(plane: ReceiverPlane, offset: vec2f) -> f32 {
    let rise = dot(plane.gradient, offset);
    let divisor = 1.0 - rise * plane.inverse_reach;
    let z = plane.depth + rise / max(divisor, 1e-18);
    // A ray that the plane has turned away from never meets it.
    return select(clamp(z, -1.0, 1.0), 1.0, divisor <= 0.0);
}

// moment_shadows/techniques/percentage_closer.wgsl

// Percentage closer filtering: tests against the plain depth map, whose results are filtered (Reeves, Salesin and Cook,
// "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987).
//
// Each tap compares one texel with the depth of the receiver's plane at that very texel and is 1 where the map is
// nearer to the light, 0 where it is not or equal. A receiver without gradient is compared with its own depth. Beyond the
// edge of its region (within the map, see `map_region_within`) the last texel repeats; a region without texels does not
// shadow. All intensities are in [0, 1]. The cost grows with the square of the kernel; filterable maps are there to avoid that.

// The largest radius of a kernel in texels.
const PERCENTAGE_CLOSER_LARGEST_RADIUS: i32 = 64;

// The largest radius of a disk in texels.
const PERCENTAGE_CLOSER_LARGEST_DISK: f32 = 4096.0;

// Any separable kernel. Filled by the host-side `PercentageCloserKernel`.
struct PercentageCloserKernel {
    // Texels on either side of the centre, at most 64.
    radius: u32,
    // 2 radius + 1 weights, not negative, the same along both axes; they need not sum to 1. A kernel of an even number of
    // texels has a 0 at one end.
    weights: array<vec4f, 33>,
}

// Where the taps of a kernel are centred.
struct PercentageCloserPlace {
    // A texel, counted from the region's origin.
    base: vec2i,
    // The share of the kernel around the next texel in x and y, in [0, 1).
    fraction: vec2f,
}

// The texel of the region that stands for `texel` (counted from its origin): itself or the nearest one.
fn percentage_closer_texel(region: MapRegion, texel: vec2i) -> vec2i {
    return clamp(texel, vec2i(0), max(vec2i(region.extent), vec2i(1)) - 1);
}

// The moment depth of that texel.
fn percentage_closer_map_depth(map: texture_depth_2d_array, layer: u32, region: MapRegion, conversion: DepthConversion, texel: vec2i) -> f32 {
    return depth_to_moment_depth(textureLoad(map, vec2i(region.origin) + percentage_closer_texel(region, texel), layer, 0), conversion);
}

// The moment depth of the receiver's plane at the centre of that texel.
fn percentage_closer_plane_depth(region: MapRegion, plane: ReceiverPlane, texel: vec2i) -> f32 {
    let centre = vec2f(percentage_closer_texel(region, texel)) + 0.5;
    return receiver_plane_depth(plane, centre - plane.uv * vec2f(region.extent));
}

// One tap: 1 if the map is nearer to the light than the receiver's plane, else 0.
fn percentage_closer_tap(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, texel: vec2i) -> f32 {
    let nearer = percentage_closer_map_depth(map, layer, region, conversion, texel) < percentage_closer_plane_depth(region, plane, texel);
    return select(0.0, 1.0, nearer && all(region.extent > vec2u(0u)));
}

// The binary test at the nearest texel: 0 or 1.
fn percentage_closer_binary(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion) -> f32 {
    return percentage_closer_tap(map, layer, region, plane, conversion, vec2i(plane.uv * vec2f(region.extent)));
}

// Where a kernel is centred: at the nearest texel, or, interpolated as in a bilinear lookup, between the four next ones.
fn percentage_closer_place(region: MapRegion, plane: ReceiverPlane, interpolated: bool) -> PercentageCloserPlace {
    let extent = max(vec2f(region.extent), vec2f(1.0));
    let place = clamp(plane.uv * extent, vec2f(0.5), extent - 0.5);
    let low = floor(place - 0.5);
    if interpolated {
        return PercentageCloserPlace(vec2i(low), place - 0.5 - low);
    }
    return PercentageCloserPlace(vec2i(place), vec2f(0.0));
}

// The weight of an offset along one axis: the Gaussian, or 1 for a sigma of 0, up to the radius `reach`.
fn percentage_closer_weight(offset: i32, reach: i32, sigma: f32) -> f32 {
    if abs(offset) > reach {
        return 0.0;
    }
    if sigma == 0.0 {
        return 1.0;
    }
    return gaussian_weight(f32(offset), sigma);
}

// Shadow intensity with equal weights: n x n texels with n = 2 radius + 1. `radius` from 0 to 64. Interpolated, results are
// blended as a bilinear lookup in a filtered map does, with n + 1 taps along each axis.
fn percentage_closer_box(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32, interpolated: bool) -> f32 {
    return percentage_closer_filter(map, layer, region, plane, conversion, radius, 0.0, interpolated);
}

// The same with the weights of a Gaussian of standard deviation `sigma` > 0 texels, cut off at `radius`; a smaller sigma
// counts as 1e-3.
fn percentage_closer_gaussian(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32, sigma: f32, interpolated: bool) -> f32 {
    return percentage_closer_filter(map, layer, region, plane, conversion, radius, max(sigma, 1e-3), interpolated);
}

// Both of them: a sigma of 0 stands for equal weights.
fn percentage_closer_filter(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32, sigma: f32, interpolated: bool) -> f32 {
    let reach = clamp(radius, 0, PERCENTAGE_CLOSER_LARGEST_RADIUS);
    let place = percentage_closer_place(region, plane, interpolated);
    let end = reach + select(0, 1, interpolated);
    var sum = 0.0;
    var total = 0.0;
    for (var y = -reach; y <= end; y++) {
        let row = mix(percentage_closer_weight(y, reach, sigma), percentage_closer_weight(y - 1, reach, sigma), place.fraction.y);
        for (var x = -reach; x <= end; x++) {
            let column = mix(percentage_closer_weight(x, reach, sigma), percentage_closer_weight(x - 1, reach, sigma), place.fraction.x);
            sum = fma(row * column, percentage_closer_tap(map, layer, region, plane, conversion, place.base + vec2i(x, y)), sum);
            total = fma(row, column, total);
        }
    }
    // The centre's weight is 1, so the total is not much below 1.
    return clamp(sum / total, 0.0, 1.0);
}

// The weight of an offset along one axis in a kernel of that radius. A copy of all weights per tap would cost more than the tap.
fn percentage_closer_kernel_weight(weights: ptr<function, array<vec4f, 33>>, offset: i32, reach: i32) -> f32 {
    if abs(offset) > reach {
        return 0.0;
    }
    let index = u32(offset + reach);
    return clamp((*weights)[index / 4u][index % 4u], 0.0, 1e9);
}

// The same with any separable kernel. Without a positive weight nothing is shadowed.
fn percentage_closer_kernel(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, kernel: PercentageCloserKernel, interpolated: bool) -> f32 {
    let reach = i32(min(kernel.radius, u32(PERCENTAGE_CLOSER_LARGEST_RADIUS)));
    var weights = kernel.weights;
    let place = percentage_closer_place(region, plane, interpolated);
    let end = reach + select(0, 1, interpolated);
    var sum = 0.0;
    var total = 0.0;
    for (var y = -reach; y <= end; y++) {
        let row = mix(percentage_closer_kernel_weight(&weights, y, reach), percentage_closer_kernel_weight(&weights, y - 1, reach), place.fraction.y);
        for (var x = -reach; x <= end; x++) {
            let column = mix(percentage_closer_kernel_weight(&weights, x, reach), percentage_closer_kernel_weight(&weights, x - 1, reach), place.fraction.x);
            sum = fma(row * column, percentage_closer_tap(map, layer, region, plane, conversion, place.base + vec2i(x, y)), sum);
            total = fma(row, column, total);
        }
    }
    return clamp(sum / max(total, 1e-30), 0.0, 1.0);
}

// The texel, counted from the region's origin, that lies `offset` texels from the receiver, which may be outside.
fn percentage_closer_texel_at(region: MapRegion, plane: ReceiverPlane, offset: vec2f) -> vec2i {
    return vec2i(floor(plane.uv * vec2f(region.extent) + offset));
}

// Shadow intensity with a Poisson disk of 16 taps: `radius` in texels, 0 to 4096, turned by `angle` in radians, another
// one in each pixel (`disk_samples_angle`).
fn percentage_closer_poisson(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: f32, angle: f32) -> f32 {
    let rotation = disk_samples_rotation(angle) * clamp(radius, 0.0, PERCENTAGE_CLOSER_LARGEST_DISK);
    var sum = 0.0;
    for (var tap = 0u; tap < DISK_SAMPLES_POISSON_COUNT; tap++) {
        let texel = percentage_closer_texel_at(region, plane, disk_samples_poisson(tap, rotation));
        sum += percentage_closer_tap(map, layer, region, plane, conversion, texel);
    }
    return sum / f32(DISK_SAMPLES_POISSON_COUNT);
}

// moment_shadows/techniques/percentage_closer_soft.wgsl

// Percentage closer soft shadows: penumbrae that widen with the distance from the occluder (Fernando, "Percentage-Closer
// Soft Shadows", SIGGRAPH 2005 sketches).
//
// A first set of taps searches for blockers, texels nearer to the light than the receiver's plane. Their mean depth tells
// how wide the light appears from the receiver when it is projected through the blockers onto the map: that disk is
// filtered with a second set. It is exact for a disk-shaped light and one blocker parallel to the map.
//
// The plane, regions and what lies beyond their edge are those of `percentage_closer`. Taps lie on disks of any number of
// samples, which each pixel turns by another angle.

// What the search has found.
struct PercentageCloserSoftBlockers {
    // The share of taps that are blockers, in [0, 1].
    share: f32,
    // Their mean moment depth; -1 without blockers.
    depth: f32,
}

// The largest number of taps.
const PERCENTAGE_CLOSER_SOFT_MOST_TAPS: u32 = 4096u;

// Searches a disk of the given radius in texels for blockers.
fn percentage_closer_soft_search(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: vec2f, taps: u32, rotation: vec2f) -> PercentageCloserSoftBlockers {
    let count = clamp(taps, 1u, PERCENTAGE_CLOSER_SOFT_MOST_TAPS);
    var blockers = 0.0;
    var sum = 0.0;
    for (var tap = 0u; tap < count; tap++) {
        let texel = percentage_closer_texel_at(region, plane, radius * disk_samples_vogel(tap, count, rotation));
        let depth = percentage_closer_map_depth(map, layer, region, conversion, texel);
        if depth < percentage_closer_plane_depth(region, plane, texel) {
            blockers += 1.0;
            sum += depth;
        }
    }
    return PercentageCloserSoftBlockers(blockers / f32(count), select(-1.0, sum / max(blockers, 1.0), blockers > 0.0));
}

// The share in [0, 1] of a disk's taps, of the given radius in texels, that are in shadow.
fn percentage_closer_soft_filter(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: vec2f, taps: u32, rotation: vec2f) -> f32 {
    let count = clamp(taps, 1u, PERCENTAGE_CLOSER_SOFT_MOST_TAPS);
    var sum = 0.0;
    for (var tap = 0u; tap < count; tap++) {
        let texel = percentage_closer_texel_at(region, plane, radius * disk_samples_vogel(tap, count, rotation));
        sum += percentage_closer_tap(map, layer, region, plane, conversion, texel);
    }
    return clamp(sum / f32(count), 0.0, 1.0);
}

// Shadow intensity in [0, 1]: 0 without blockers, 1 where the search found nothing else. `search_taps` and `filter_taps`
// from 1 to 4096; both disks are turned by `angle` in radians (`disk_samples_angle`).
fn percentage_closer_soft_intensity(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, light: AreaLight, search_taps: u32, filter_taps: u32, angle: f32) -> f32 {
    if any(region.extent == vec2u(0u)) {
        return 0.0;
    }
    let rotation = disk_samples_rotation(angle);
    // A blocker at the near end spreads farthest.
    let search_radius = area_light_disk(light, -1.0, plane.depth);
    let blockers = percentage_closer_soft_search(map, layer, region, plane, conversion, search_radius, search_taps, rotation);
    if blockers.share <= 0.0 || blockers.share >= 1.0 {
        return select(0.0, 1.0, blockers.share >= 1.0);
    }
    let radius = area_light_disk(light, blockers.depth, plane.depth);
    return percentage_closer_soft_filter(map, layer, region, plane, conversion, radius, filter_taps, rotation);
}

// technique_map

// A plain depth map.

@group(GROUP) @binding(2) var depth_map: texture_depth_2d_array;

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(depth_map);
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

// technique

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, depth_of_light(receiver.conversion));
    return percentage_closer_soft_intensity(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, receiver.light, SEARCH_TAPS, FILTER_TAPS, disk_samples_angle(receiver.pixel));
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
