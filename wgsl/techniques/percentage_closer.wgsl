import super::super::map::depth::{DepthConversion, depth_to_moment_depth};
import super::super::maths::disk_samples::{DISK_SAMPLES_POISSON_COUNT, disk_samples_poisson, disk_samples_rotation};
import super::super::filter::gaussian::{gaussian_weight};
import super::super::map::map_region::{MapRegion};
import super::super::shade::receiver_plane::{ReceiverPlane, receiver_plane_depth};

// Percentage closer filtering: tests against the plain depth map, whose results are filtered (Reeves, Salesin and Cook,
// "Rendering Antialiased Shadows with Depth Maps", SIGGRAPH 1987).
//
// Each tap compares one texel with the depth of the receiver's plane at that very texel and is 1 where the map is nearer to
// the light, 0 where it is farther or equal. A receiver without gradient is compared with its own depth. Beyond the edge of
// its region (within the map, see `map_region_within`) the last texel repeats; a region without texels does not shadow. All
// intensities are in [0, 1]. The cost grows with the square of the kernel, which filterable maps avoid.

// The largest radius of a kernel in texels.
const PERCENTAGE_CLOSER_LARGEST_RADIUS: i32 = 64;

// The largest radius of a disk in texels.
const PERCENTAGE_CLOSER_LARGEST_DISK: f32 = 4096.0;

// Any separable kernel.
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

// Where a kernel is centred: between the four nearest texels, as a bilinear lookup is.
fn percentage_closer_place(region: MapRegion, plane: ReceiverPlane) -> PercentageCloserPlace {
    let extent = max(vec2f(region.extent), vec2f(1.0));
    let place = clamp(plane.uv * extent, vec2f(0.5), extent - 0.5);
    let low = floor(place - 0.5);
    return PercentageCloserPlace(vec2i(low), place - 0.5 - low);
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

// Shadow intensity with equal weights: n x n texels with n = 2 radius + 1. `radius` from 0 to 64. Results are
// blended as a bilinear lookup in a filtered map does, with n + 1 taps along each axis.
fn percentage_closer_box(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32) -> f32 {
    return percentage_closer_filter(map, layer, region, plane, conversion, radius, 0.0);
}

// Shadow intensity with the weights of a Gaussian of standard deviation `sigma` > 0 texels, cut off at `radius`; a smaller
// sigma counts as 1e-3. `radius` and blending are as in `percentage_closer_box`.
fn percentage_closer_gaussian(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32, sigma: f32) -> f32 {
    return percentage_closer_filter(map, layer, region, plane, conversion, radius, max(sigma, 1e-3));
}

// Shadow intensity with equal weights or those of a Gaussian: a sigma of 0 stands for equal weights.
fn percentage_closer_filter(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32, sigma: f32) -> f32 {
    let reach = clamp(radius, 0, PERCENTAGE_CLOSER_LARGEST_RADIUS);
    let place = percentage_closer_place(region, plane);
    var sum = 0.0;
    var total = 0.0;
    for (var y = -reach; y <= reach + 1; y++) {
        let row = mix(percentage_closer_weight(y, reach, sigma), percentage_closer_weight(y - 1, reach, sigma), place.fraction.y);
        for (var x = -reach; x <= reach + 1; x++) {
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

// Shadow intensity with any separable kernel. Without a positive weight nothing is shadowed.
fn percentage_closer_kernel(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, kernel: PercentageCloserKernel) -> f32 {
    let reach = i32(min(kernel.radius, u32(PERCENTAGE_CLOSER_LARGEST_RADIUS)));
    var weights = kernel.weights;
    let place = percentage_closer_place(region, plane);
    var sum = 0.0;
    var total = 0.0;
    for (var y = -reach; y <= reach + 1; y++) {
        let row = mix(percentage_closer_kernel_weight(&weights, y, reach), percentage_closer_kernel_weight(&weights, y - 1, reach), place.fraction.y);
        for (var x = -reach; x <= reach + 1; x++) {
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

// Shadow intensity with a Poisson disk of 16 taps: `radius` in texels, 0 to 4096, turned by `angle` in radians, which differs
// from pixel to pixel (`disk_samples_angle`).
fn percentage_closer_poisson(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: f32, angle: f32) -> f32 {
    let rotation = disk_samples_rotation(angle) * clamp(radius, 0.0, PERCENTAGE_CLOSER_LARGEST_DISK);
    var sum = 0.0;
    for (var tap = 0u; tap < DISK_SAMPLES_POISSON_COUNT; tap++) {
        let texel = percentage_closer_texel_at(region, plane, disk_samples_poisson(tap, rotation));
        sum += percentage_closer_tap(map, layer, region, plane, conversion, texel);
    }
    return sum / f32(DISK_SAMPLES_POISSON_COUNT);
}
