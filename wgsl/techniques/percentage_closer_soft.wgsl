import super::super::shade::area_light::{AreaLight, area_light_disk};
import super::super::map::depth::{DepthConversion};
import super::super::maths::disk_samples::{disk_samples_rotation, disk_samples_vogel};
import super::super::map::map_region::{MapRegion};
import super::super::techniques::percentage_closer::{percentage_closer_map_depth, percentage_closer_plane_depth, percentage_closer_tap, percentage_closer_texel_at};
import super::super::shade::receiver_plane::{ReceiverPlane};

// Percentage closer soft shadows: penumbrae that widen with the distance from the occluder (Fernando, "Percentage-Closer
// Soft Shadows", SIGGRAPH 2005 sketches).
//
// A first set of taps searches for blockers, texels nearer to the light than the receiver's plane. Their mean depth tells
// how wide the light appears from the receiver when it is projected through the blockers onto the map: that disk is
// filtered with a second set. It is exact for a disk-shaped light and one blocker parallel to the map.
//
// The plane, regions and what lies beyond their edge are those of `percentage_closer`. Taps lie on disks of any number of
// samples, which each pixel turns by a different angle.

// The result of the search.
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
