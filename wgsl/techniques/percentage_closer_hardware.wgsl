import super::super::map::depth::{DepthConversion, depth_from_moment_depth};
import super::super::map::map_region::{MapRegion};
import super::super::techniques::percentage_closer::{PERCENTAGE_CLOSER_LARGEST_RADIUS};
import super::super::shade::receiver_plane::{ReceiverPlane, receiver_plane_depth};

// Percentage closer filtering by comparison samplers: each tap tests 2 x 2 texels and blends the results, as hardware does
// for the price of one texel. Weights have as few as 8 bits.
//
// The sampler filters linearly, and its comparison tells whether a texel is nearer to the light than the reference value:
// `greater` (reference > texel) where stored depth grows away from the light, `less` where it is reversed.

// How far, in texels, taps keep from the border of a region beyond the half texel that a filter reaches: coordinates are
// rounded, and by less than that in maps of up to 16384 texels. A region a single texel wide has no room for it.
const PERCENTAGE_CLOSER_HARDWARE_INSET: f32 = 0.001953125;

// One tap at `place`, in texels from the region's origin, at least half a texel inside of the region: the share in [0, 1] of
// the four texels around it, weighted bilinearly, that are nearer to the light than the receiver's plane.
//
// All four are compared with the least depth of the plane at their centres: a slope does not shadow itself, but an occluder
// closer to the plane than it rises over a texel is missed.
fn percentage_closer_hardware_tap(map: texture_depth_2d_array, comparison: sampler_comparison, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, place: vec2f) -> f32 {
    let centre = floor(place - 0.5) + select(vec2f(0.5), vec2f(1.5), plane.gradient < vec2f(0.0));
    let depth = receiver_plane_depth(plane, centre - plane.uv * vec2f(region.extent));
    let uv = (vec2f(region.origin) + place) / vec2f(textureDimensions(map));
    let nearer = textureSampleCompareLevel(map, comparison, uv, layer, depth_from_moment_depth(depth, conversion));
    // Nothing is nearer than the near end, not even what is stored in front of it.
    return select(clamp(nearer, 0.0, 1.0), 0.0, depth <= -1.0);
}

// Shadow intensity in [0, 1] by n x n taps (`percentage_closer_hardware_tap`) of equal weight, n = 2 radius + 1, one texel
// apart: an interpolated box of n x n texels (`percentage_closer_box`). `radius` from 0 to 64. Beyond the edge of its region,
// which lies within the map, the last texel repeats; a region without texels does not shadow.
fn percentage_closer_hardware_box(map: texture_depth_2d_array, comparison: sampler_comparison, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, radius: i32) -> f32 {
    if any(region.extent == vec2u(0u)) {
        return 0.0;
    }
    let reach = clamp(radius, 0, PERCENTAGE_CLOSER_LARGEST_RADIUS);
    let extent = vec2f(region.extent);
    let low = min(vec2f(0.5 + PERCENTAGE_CLOSER_HARDWARE_INSET), 0.5 * extent);
    let centre = clamp(plane.uv * extent, low, extent - low);
    var sum = 0.0;
    for (var y = -reach; y <= reach; y++) {
        for (var x = -reach; x <= reach; x++) {
            let place = clamp(centre + vec2f(vec2i(x, y)), low, extent - low);
            sum += percentage_closer_hardware_tap(map, comparison, layer, region, plane, conversion, place);
        }
    }
    let taps = f32((2 * reach + 1) * (2 * reach + 1));
    return clamp(sum / taps, 0.0, 1.0);
}
