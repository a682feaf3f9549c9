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
const STORAGE = 2u;
const EXPONENTS = vec2f(40.0, 0.0);
const BOTH_WARPS = false;

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

// moment_shadows/moments/two_moments.wgsl

// Two moments of depth: encoding, storage, smallest variance.
//
// A texel holds the mean b1 of depth and its mean square b2. Channels come in pairs (b1, b2): variance shadow mapping uses xy alone;
// a technique that stores two pairs encodes both at once.

// The smallest variance per storage: what rounding in a resolve and a two-pass blur can take away from b2 - b1^2. With e
// the error of a channel per rounding it is at most 3 (error of b2 + 2 |b1| error of b1):
//   unorm16: e = 2^-17, b1 = 2 r - 1 and b2 = 1 - g:   3 (e + 4 e) = 1.2e-4
//   float16: e = 2^-13 for channels within one half:   3 (e + 4 e) = 1.9e-3
//   float32: e = 2^-25 for values up to 1:             3 (e + 2 e) = 2.7e-7, and the sums of both passes are in float32
// That is with all errors on one side. Half of it covers 99.999 % of adversarial kernels in unorm16 and float16; the sums
// of float32 need a bit more than theirs. A floor as large as the error leaves no variance wrong by more than a factor of 2.
const TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16: f32 = 6e-5;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16: f32 = 1e-3;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32: f32 = 5e-7;

// What is averaged for a depth z in [-1, 1]: its powers.
fn two_moments_from_depth(z: f32) -> vec4f {
    return vec4f(z, z * z, 0.0, 0.0);
}

// What to write for averaged channels. In unorm16 the optimised basis of two moments (r, g) = (u1, 4 u1 - 4 u2), with u the
// moments of (z + 1) / 2 (i3D 2015, section 3.2), which fills the unit square and in terms of z is simply
// ((b1 + 1) / 2, 1 - b2). In float16 the same less one half, around which half precision is finest. In float32 b itself.
fn two_moments_to_texel(channels: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return channels;
    }
    let optimised = saturate(fma(vec4f(0.5, -1.0, 0.5, -1.0), channels, vec4f(0.5, 1.0, 0.5, 1.0)));
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(optimised - 0.5);
    }
    return optimised;
}

// The moments in a (filtered) texel, both pairs, in their ranges whatever the texel holds.
fn two_moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    let finite = storage_finite_texel(texel, storage);
    var channels = finite;
    if storage != STORAGE_FLOAT32 {
        let offset = select(vec4f(-1.0, 1.0, -1.0, 1.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
        channels = fma(vec4f(2.0, -1.0, 2.0, -1.0), finite, offset);
    }
    return clamp(channels, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// The smallest variance of a storage.
fn two_moments_smallest_variance_of(storage: u32) -> f32 {
    if storage == STORAGE_FLOAT32 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16;
    }
    return TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16;
}

// moment_shadows/bounds/chebyshev.wgsl

// Variance shadow mapping: the sharpest bound on shadow intensity that two moments allow.
//
// A texel holds the mean b1 of depth and its mean square b2. The share of depth in front of the fragment is at least
// d^2 / (b2 - b1^2 + d^2) for a fragment at d > 0 behind the mean (Chebyshev's inequality, one-sided; Donnelly &
// Lauritzen, "Variance Shadow Maps", i3D 2006, equation 5). One plane in front of another is reproduced exactly; behind
// two occluders light bleeds (Lauritzen, thesis 2008, section 3.4).

// inf S(z < fragment_depth) over all distributions S with the mean and mean square `moments`; 0 exactly for fragments
// that are not behind the mean. Any unit of depth will do as long as no square exceeds 2^126; `smallest_variance` > 0 is in
// the square of that unit.
fn chebyshev_lower_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    let variance = max(fma(-moments.x, moments.x, moments.y), smallest_variance);
    let distance = max(fragment_depth - moments.x, 0.0);
    let square = distance * distance;
    return square / (variance + square);
}

// sup S(z <= fragment_depth) likewise; 1 exactly for fragments that are not in front of the mean.
fn chebyshev_upper_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    return 1.0 - chebyshev_lower_bound(vec2f(-moments.x, moments.y), -fragment_depth, smallest_variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound.
fn chebyshev_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, storage: u32) -> f32 {
    let moments = two_moments_from_texel(texel, storage).xy;
    return chebyshev_lower_bound(moments, depth_of_fragment(fragment_depth), two_moments_smallest_variance_of(storage));
}

// moment_shadows/techniques/exponential_variance.wgsl

// Exponential variance shadow mapping: the bound of two moments for warped depth.
//
// Warping depth by an increasing function keeps every lower bound one. w+ = e^(c+ z) pulls all occluders but the last ones
// together, so that less light bleeds behind them, w- = -e^(-c- z) does the same for receivers; the darker bound of both is
// taken (Lauritzen & McCool, "Layered Variance Shadow Maps", GI 2008, section 6; Lauritzen, thesis 2008, section 4.2). The
// minus sign in w- is what makes it increase. With w+ alone two channels do (EVSM2), with both four (EVSM4).
//
// Warps are not normalised: e^(c z) for signed z spends the exponent range of a float evenly on both sides of 1, while
// e^(c (z - 1)) would leave the upper half of it unused.

// The largest exponents, so that w and w^2 fit the storage.
//   float32: both stay normal numbers, e^(2 c) <= 2^126, so c <= 63 log 2 = 43.67. Two such squares may be added, which
//            those of 44.36 = log(largest float32) / 2 may not.
//   float16: w^2 <= 65504, so c <= 5.54. Far squares then are subnormal, which the smallest variance covers.
// Larger exponents make no NaN, but what they give is no bound.
const EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16: f32 = 5.54;
const EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32: f32 = 43.6;

// 2^63, above e^43.6.
const EXPONENTIAL_VARIANCE_LARGEST_WARP: f32 = 9.223372036854776e18;

// The smallest variance is x * E[w^2] + y. It is the error that rounding in a resolve and a two-pass blur leaves in
// E[w^2] - E[w]^2: with the relative error u = 2^-11 or 2^-24 of a rounding at most 3 (u + 2 u) E[w^2] = 4.4e-3 or 5.4e-7
// times E[w^2]. In depth, where w has the slope c w, that is a variance of x / c^2. As in `variance` half of it covers
// 99.999 % of kernels in float16. y covers numbers below the normal ones: 3 steps of 2^-25, or what float32 flushes to zero.
const EXPONENTIAL_VARIANCE_SMALLEST_FLOAT16: vec2f = vec2f(2.2e-3, 9e-8);
const EXPONENTIAL_VARIANCE_SMALLEST_FLOAT32: vec2f = vec2f(6e-7, 1e-37);

// The largest exponent of a storage, for either warp.
fn exponential_variance_largest_exponent(storage: u32) -> f32 {
    let is_half = storage == STORAGE_FLOAT16;
    return select(
        EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32,
        EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16,
        is_half,
    );
}

// The warps (w+, w-) of a depth in [-1, 1] with the exponents (c+, c-).
fn exponential_variance_warp(z: f32, exponents: vec2f) -> vec2f {
    let limited = clamp(exponents, vec2f(0.0), vec2f(EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32));
    return vec2f(exp(limited.x * z), -exp(-limited.y * z));
}

// What is averaged for a depth z in [-1, 1]: (w+, w+^2, w-, w-^2). EVSM2 stores the first two.
fn exponential_variance_channels(z: f32, exponents: vec2f) -> vec4f {
    let warped = exponential_variance_warp(z, exponents);
    return vec4f(warped, warped * warped).xzyw;
}

// What to write for averaged channels.
fn exponential_variance_to_texel(channels: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT16 {
        let largest = vec4f(STORAGE_LARGEST_FLOAT16);
        return storage_round_to_float16(clamp(channels, -largest, largest));
    }
    return channels;
}

// The lower bound for a warped fragment and the first two moments of the same warp, which may be any finite numbers. The
// fragment's warp is within 2^63.
fn exponential_variance_lower_bound(moments: vec2f, warped: f32, storage: u32) -> f32 {
    let largest = EXPONENTIAL_VARIANCE_LARGEST_WARP;
    let clamped = clamp(moments, vec2f(-largest, 0.0), vec2f(largest, largest * largest));
    let is_half = storage == STORAGE_FLOAT16;
    let smallest = select(EXPONENTIAL_VARIANCE_SMALLEST_FLOAT32, EXPONENTIAL_VARIANCE_SMALLEST_FLOAT16, is_half);
    return chebyshev_lower_bound(clamped, warped, fma(smallest.x, clamped.y, smallest.y));
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound, from
// both warps or from w+ alone.
fn exponential_variance_shadow_intensity_of_texel(
    texel: vec4f,
    fragment_depth: f32,
    storage: u32,
    exponents: vec2f,
    both: bool,
) -> f32 {
    let warped = exponential_variance_warp(depth_of_fragment(fragment_depth), exponents);
    let moments = storage_finite_texel(texel, storage);
    let positive = exponential_variance_lower_bound(moments.xy, warped.x, storage);
    if !both {
        return positive;
    }
    // A mean of w- is negative; positive garbage would put the mean behind every fragment, which is no harm.
    return max(positive, exponential_variance_lower_bound(moments.zw, warped.y, storage));
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

// moments_lookup

// The lookup in a map that the device cannot filter, or not as well over a pixel.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;

// The texel at `uv` in [0, 1] across a region, filtered over a pixel with these differences of place to its neighbours.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    if LEVELS == 1u {
        return map_load_bilinear(moments_map, layer, region, uv, 0u);
    }
    let footprint = minification_footprint(difference_x, difference_y, ANISOTROPY);
    return map_load_footprint(moments_map, layer, region, LEVELS, uv, footprint);
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
    return exponential_variance_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENTS, BOTH_WARPS);
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
