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
    let scale = select(select(1.0, 0x1p-64, most > 0x1p64), 0x1p64, most < 0x1p-40);
    let large = most * scale;
    let small = min(magnitudes.x, magnitudes.y) * scale;
    if large < 0x1p-60 {
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

// The place of `uv` (from 0 to 1 across the region) in texels of a region's mip level, kept half a texel away from its
// edge: a bilinear filter there reads no other region.
fn map_region_place(region_on_level: MapRegion, uv: vec2f) -> vec2f {
    let extent = vec2f(region_on_level.extent);
    return vec2f(region_on_level.origin) + clamp(uv * extent, vec2f(0.5), max(extent - 0.5, vec2f(0.5)));
}

// moment_shadows/map/storage.wgsl
// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that its bound has to
// cover. Nothing here depends on a technique: how one spreads its quantities over the range of a storage is its own.

const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;

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
    let small = round(value * 0x1p24) * 0x1p-24;
    return select(rounded, small, abs(value) < vec4f(0x1p-14));
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


// specialization
const GROUP = 0;
const SOURCE_STORAGE = 1u;

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

// Radius and azimuth at a place.
fn rectified_frame_ray(frame: RectifiedFrame, place: vec2f) -> vec2f {
    return vec2f(place.x * frame.largest_radius, fma(place.y, frame.azimuth_extent, frame.first_azimuth));
}

// The depth along the light in [-1, 1] of an inclination.
fn rectified_frame_depth(frame: RectifiedFrame, inclination: f32) -> f32 {
    let extent = frame.largest_inclination - frame.smallest_inclination;
    return clamp(fma(2.0 / extent, frame.largest_inclination - inclination, -1.0), -1.0, 1.0);
}


// rectified_texel

// Four moments of two occluders in rectified coordinates.

fn rectified_texel(depths: vec2f, weights: vec2f) -> vec4f {
    let sums = weights.x * four_moments_from_depth(depths.x) + weights.y * four_moments_from_depth(depths.y);
    return four_moments_to_texel(sums, STORAGE);
}

// moment_shadows/maths/two_diracs.wgsl
// Two depths with weights that have given first three moments: what a filtered texel of a shadow map is resampled as.
//
// There is exactly one such pair (Peters et al., supplement of "Beyond Hard Shadows", i3D 2016, theorem 1). About the mean,
// with the variance c and half of the regression slope's excess d, the depths are d -+ sqrt(d^2 + c): nothing cancels, where
// the published form takes the root of a difference.

// Two depths and their weights, which sum to one.
struct TwoDiracs {
    // In rising order.
    depths: vec2f,
    // Not negative.
    weights: vec2f,
}

// The variance that rounding of f32 moments leaves no digit of; smaller ones count as this. It moves moments by as much.
const TWO_DIRACS_SMALLEST_VARIANCE: f32 = 1e-7;

// Of the moments b1, b2, b3 of depths in [-1, 1]. Moments that no distribution has, if they are finite, give finite depths,
// which may lie outside of [-1, 1].
fn two_diracs_of_moments(moments: vec3f) -> TwoDiracs {
    let b = clamp(moments, vec3f(-1.0, 0.0, -1.0), vec3f(1.0));
    let variance = max(fma(-b.x, b.x, b.y), TWO_DIRACS_SMALLEST_VARIANCE);
    let d = 0.5 * fma(-b.x, b.y, b.z) / variance - b.x;
    let root = sqrt(fma(d, d, variance));
    let sum = abs(d) + root;
    // The depth on the side of d is farther from the mean, and has the smaller weight.
    let near = variance / sum;
    let small = 0.5 * near / root;
    let low = select(vec2f(-sum, small), vec2f(-near, 1.0 - small), d >= 0.0);
    let high = select(vec2f(near, 1.0 - small), vec2f(sum, small), d >= 0.0);
    return TwoDiracs(b.x + vec2f(low.x, high.x), vec2f(low.y, high.y));
}

// rectify_moments.wgsl

// Resamples a filtered map of four moments in rectified coordinates: one texel, which is one light ray, per invocation.
//
// Depth along the light is not linear in the depth of the light's map, so moments cannot be converted; the two depths that stand
// for a texel can (Peters et al., JCGT 6(1) 2017, section 7). Every texel is looked up in the light's map, so there are no
// holes, whatever the directions of camera and light.

struct RectifyMomentsParameters {
    frame: RectifiedFrame,
    // Where the light ray through the camera meets the light's map, from 0 to 1 across the region, and by how much that
    // changes along the frame's first and second axis per scene unit.
    map_at_camera: vec2f,
    map_along_first: vec2f,
    map_along_second: vec2f,
    // The light's moment depth at the camera, and by how much it grows along the light per scene unit.
    depth_at_camera: f32,
    depth_per_length: f32,
    // Where the light's view lies in its map.
    region: MapRegion,
    layer: u32,
}

@group(GROUP) @binding(0) var<uniform> parameters: RectifyMomentsParameters;
@group(GROUP) @binding(1) var rectified_map: MomentsStorage;

// From here on depths of the light's map are its far end, where there are no casters: those of filtered texels spread by
// what a storage's rounding leaves of them.
const FAR_END = 0.97;

// The rectified depth of an occluder at a depth of the light's map, on the light ray of a radius.
fn rectified(depth: f32, radius: f32) -> f32 {
    let along = (max(depth, -1.0) - parameters.depth_at_camera) / parameters.depth_per_length;
    let rectified = rectified_frame_depth(parameters.frame, angle_atan2(radius, along));
    return select(rectified, 1.0, depth >= FAR_END);
}

@compute @workgroup_size(8, 8)
fn rectify(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(rectified_map);
    if any(id.xy >= size) {
        return;
    }
    // Columns are intervals of the radius, rows azimuths from end to end.
    let place = vec2f((f32(id.x) + 0.5) / f32(size.x), f32(id.y) / f32(max(size.y, 2u) - 1u));
    let ray = rectified_frame_ray(parameters.frame, place);
    let turn = angle_sin_cos(ray.y);
    let outwards = turn.y * parameters.map_along_first + turn.x * parameters.map_along_second;
    let around = turn.y * parameters.map_along_second - turn.x * parameters.map_along_first;
    let uv = parameters.map_at_camera + ray.x * outwards;
    if any(uv < vec2f(0.0)) || any(uv > vec2f(1.0)) {
        // What the light's map does not know casts no shadow.
        textureStore(rectified_map, id.xy, rectified_texel(vec2f(1.0), vec2f(0.5)));
        return;
    }
    let region = map_region_within(parameters.region, textureDimensions(moments_map));
    let texels = vec2f(region.extent);
    let column = parameters.frame.largest_radius / f32(size.x) * texels * outwards;
    let row = ray.x * parameters.frame.azimuth_extent / f32(size.y) * texels * around;
    let texel = moments_lookup(parameters.layer, region, uv, column, row);
    let moments = four_moments_from_texel(storage_finite_texel(texel, SOURCE_STORAGE), SOURCE_STORAGE);
    let occluders = two_diracs_of_moments(moments.xyz);
    // View rays that end within the first column run along the light: whatever is before the camera shadows all of them.
    let radius = select(ray.x, 0.0, id.x == 0u);
    let depths = vec2f(rectified(occluders.depths.x, radius), rectified(occluders.depths.y, radius));
    textureStore(rectified_map, id.xy, rectified_texel(depths, occluders.weights));
}
