import super::super::map::range_fit::{RangeFit};

// Area lights: how wide a light appears on its map when a receiver sees it through a blocker.
//
// The light's outline, projected from the receiver through the blocker onto the map, is what a filter has to average for a
// penumbra (Fernando, "Percentage-Closer Soft Shadows", SIGGRAPH 2005 sketches). It is exact for one blocker parallel to the
// map. A filter whose shape differs from the light's has the same variance, which makes penumbrae equally wide.

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

// The half width of the box that stands for a disk of radius 1, and the radius of the disk that stands for a box of half
// width 1: along an axis a box of half width h has the variance h^2 / 3, a disk of radius r the variance r^2 / 4.
const AREA_LIGHT_BOX_OF_DISK: f32 = 0.8660254;
const AREA_LIGHT_DISK_OF_BOX: f32 = 1.1547005;

// The light for moment depths of a fitted range.
fn area_light_fitted(light: AreaLight, fit: RangeFit) -> AreaLight {
    let ends = fit.middle + vec2f(-1.0, 1.0) / fit.scale;
    let distances = mix(vec2f(light.near), vec2f(light.far), 0.5 * ends + 0.5);
    return AreaLight(light.size, distances.x, distances.y, light.perspective, light.smallest_radius, light.largest_radius, light.rectangular);
}

// Half the light's width and height in texels as a receiver sees it through a blocker, projected onto the map. Both depths
// are moment depths; the result is 0 for a blocker that is not in front.
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

// Half widths in texels, limited to the light's smallest and largest half width.
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
