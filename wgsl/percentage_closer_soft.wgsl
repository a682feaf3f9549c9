import super::depth::{DepthConversion};
import super::disk_samples::{disk_samples_rotation, disk_samples_vogel};
import super::map_region::{MapRegion};
import super::percentage_closer::{percentage_closer_map_depth, percentage_closer_plane_depth, percentage_closer_tap, percentage_closer_texel_at};
import super::receiver_plane::{ReceiverPlane};

// Percentage closer soft shadows: penumbrae that widen with the distance from the occluder (Fernando, "Percentage-Closer
// Soft Shadows", SIGGRAPH 2005 sketches).
//
// A first set of taps searches for blockers, texels nearer to the light than the receiver's plane. Their mean depth tells
// how wide the light appears from the receiver when it is projected through the blockers onto the map: that disk is
// filtered with a second set. It is exact for a disk-shaped light and one blocker parallel to the map.
//
// The plane, regions and what lies beyond their edge are those of `percentage_closer`. Taps lie on disks of any number of
// samples, which each pixel turns by another angle.

// A light of some size. Filled by the host-side `PercentageCloserSoftLight`.
struct PercentageCloserSoftLight {
    // Parallel rays: diameter of the filter in texels (x and y) per scene unit between blocker and receiver. Rays from a
    // point: the same in texels per 1 / scene unit of difference between the inverse distances.
    size: vec2f,
    // Distances from the light along its axis, in scene units, of the moment depths -1 and 1.
    near: f32,
    far: f32,
    // 0 for parallel rays, 1 for rays from a point.
    perspective: u32,
    // Smallest and largest radius in texels of search and filter. The smallest softens shadows near contacts; the largest
    // bounds the noise.
    smallest_radius: f32,
    largest_radius: f32,
    padding: f32,
}

// What the search has found.
struct PercentageCloserSoftBlockers {
    // The share of taps that are blockers, in [0, 1].
    share: f32,
    // Their mean moment depth; -1 without blockers.
    depth: f32,
}

// The largest number of taps.
const PERCENTAGE_CLOSER_SOFT_MOST_TAPS: u32 = 4096u;

// The largest radius in texels.
const PERCENTAGE_CLOSER_SOFT_LARGEST_RADIUS: f32 = 4096.0;

// The radius in texels (x and y) of the light as a receiver sees it through a blocker, projected onto the map. Both depths are
// moment depths; in front of the blocker the radius is the smallest one.
fn percentage_closer_soft_radius(light: PercentageCloserSoftLight, blocker_depth: f32, receiver_depth: f32) -> vec2f {
    let ends = clamp(vec2f(blocker_depth, receiver_depth), vec2f(-1.0), vec2f(1.0));
    let distances = clamp(mix(vec2f(light.near), vec2f(light.far), 0.5 * ends + 0.5), vec2f(-1e15), vec2f(1e15));
    var apart = distances.y - distances.x;
    if light.perspective != 0u {
        // 1 / near - 1 / far as one quotient keeps its digits.
        let positive = max(distances, vec2f(1e-9));
        apart = apart / (positive.x * positive.y);
    }
    let radius = 0.5 * clamp(light.size, vec2f(0.0), vec2f(1e15)) * clamp(apart, 0.0, 1e18);
    let smallest = vec2f(clamp(light.smallest_radius, 0.0, PERCENTAGE_CLOSER_SOFT_LARGEST_RADIUS));
    let largest = vec2f(clamp(light.largest_radius, 0.0, PERCENTAGE_CLOSER_SOFT_LARGEST_RADIUS));
    return min(max(radius, smallest), largest);
}

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
fn percentage_closer_soft_intensity(map: texture_depth_2d_array, layer: u32, region: MapRegion, plane: ReceiverPlane, conversion: DepthConversion, light: PercentageCloserSoftLight, search_taps: u32, filter_taps: u32, angle: f32) -> f32 {
    if any(region.extent == vec2u(0u)) {
        return 0.0;
    }
    let rotation = disk_samples_rotation(angle);
    // A blocker at the near end spreads farthest.
    let search_radius = percentage_closer_soft_radius(light, -1.0, plane.depth);
    let blockers = percentage_closer_soft_search(map, layer, region, plane, conversion, search_radius, search_taps, rotation);
    if blockers.share <= 0.0 || blockers.share >= 1.0 {
        return select(0.0, 1.0, blockers.share >= 1.0);
    }
    let radius = percentage_closer_soft_radius(light, blockers.depth, plane.depth);
    return percentage_closer_soft_filter(map, layer, region, plane, conversion, radius, filter_taps, rotation);
}
