import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_size};
import node::fullscreen::{Covered};
import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::shade::leak_reduction::{LeakReduction, leak_reduction_apply};
import moment_shadows::map::map_region::{MapRegion, map_region_within};
import moment_shadows::map::minification::{minification_depth_variance, minification_footprint};
import moment_shadows::map::range_fit::{range_fit_depth, range_fit_none};
import moment_shadows::shade::area_light::{AreaLight, area_light_fitted};
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_depth_minified, receiver_bias_fitted, receiver_bias_plane, receiver_bias_step};
import node::range_of_view::{range_of_view};
import node::specialization::{ANISOTROPY, FITTED, GROUP, LEVELS, LIGHTS, VIEWS};
import node::surface::{surface_neighbours};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::technique_receiver::{TechniqueReceiver};

// Shadow intensity of every pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target.

struct ViewParameters {
    // From the camera's clip space (x, y, stored depth, 1) to the light: x and y are the place in the map in [0, 1], z its
    // homogeneous coordinate (positive in front of the light) and w the moment depth, all times the factors they are
    // divided by. Camera and light are combined in one matrix so that no large scene coordinates occur.
    light_from_camera: mat4x4f,
    // The homogeneous coordinate of the scene position, which divides the moment depth.
    scene_w_from_camera: vec4f,
    // By rows, the scene position relative to the camera, times that coordinate: for normals.
    position_from_camera: mat3x4f,
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // The view's place in its layer; a view without texels is unused.
    region: MapRegion,
    // The stored depth of pixels that show no surface; the same for all views.
    far_depth: f32,
    // The map's layer.
    layer: u32,
    // The target's channel, 0 to 3, of which the first view that contains a pixel shades it. With BORDERS also VIEW_FADES, VIEW_ROUND,
    // and in the upper half, in sixteenths of a texel, the width of the view's border: there it gives way to the other views
    // that contain the pixel, or, where it fades, to light.
    channel: u32,
    // Texels along the region's edges that filters read, but in which no place is looked up.
    guard: f32,
    // How the light's map stores depth, and how large the light is: for tests on the plain depth map.
    conversion: DepthConversion,
    light: AreaLight,
}

// Whether borders count; otherwise they are sharp.
override BORDERS: bool = false;

// Beside a view's channel: its shadows fade out along its border, or its border is the circle within the region, a spot's cone.
const VIEW_FADES: u32 = 4u;
const VIEW_ROUND: u32 = 8u;

@group(GROUP) @binding(0) var<uniform> views: array<ViewParameters, VIEWS>;

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
    let clip = camera_depth_clip(pixel, stored_depth);
    let light = views[view].light_from_camera * clip;
    // Results behind the camera or the light are not used.
    let scene_w = max(dot(views[view].scene_w_from_camera, clip), 1e-30);
    return Receiver(vec3f(light.xy / max(light.z, 1e-30), light.w / scene_w), light.z, scene_w);
}

// No place in the map is that many texels away. Products of two differences must not overflow.
const LARGEST_DIFFERENCE: f32 = 1e9;

// How the place in the map (in texels) and the moment depth change from a pixel to its neighbour; zero without a neighbour,
// as on a surface that is edge-on to the light.
fn receiver_difference(view: u32, neighbour: vec3f, receiver: Receiver, texels: vec2f) -> vec3f {
    if all(neighbour.xy == vec2f(0.0)) {
        return vec3f(0.0);
    }
    let across_screen = vec2f(2.0, -2.0) * neighbour.xy / vec2f(camera_depth_size());
    let step = vec4f(across_screen, neighbour.z, 0.0);
    // With numerators n and divisors w, n1 / w1 - n0 / w0 = (dn - (n0 / w0) dw) / w1. Unlike the difference of two
    // places, this keeps its digits where a pixel covers a small part of a texel.
    let light = views[view].light_from_camera * step;
    let scene_w = dot(views[view].scene_w_from_camera, step);
    let across = (light.xy - receiver.place.xy * light.z) / max(receiver.light_w + light.z, 1e-30);
    let along = (light.w - receiver.place.z * scene_w) / max(receiver.scene_w + scene_w, 1e-30);
    return clamp(vec3f(across * texels, along), vec3f(-LARGEST_DIFFERENCE), vec3f(LARGEST_DIFFERENCE));
}

// Shadow intensity of a receiver that a view contains.
fn view_shadow_intensity(view: u32, pixel: vec2i, receiver: Receiver, neighbours: mat2x3f, region: MapRegion) -> f32 {
    let texels = vec2f(region.extent);
    var difference_x = receiver_difference(view, neighbours[0], receiver, texels);
    var difference_y = receiver_difference(view, neighbours[1], receiver, texels);
    // All that is a moment depth, or a difference of two, becomes one of the map's range.
    var fit = range_fit_none();
    if FITTED {
        fit = range_of_view(views[view].layer, region.origin);
        difference_x.z *= fit.scale;
        difference_y.z *= fit.scale;
    }
    let gradient = receiver_bias_plane(difference_x, difference_y);
    var settings = views[view].receiver_bias;
    if FITTED {
        settings = receiver_bias_fitted(settings, fit.scale);
    }
    var bias = receiver_bias_depth(settings, length(gradient));
    if LEVELS > 1u {
        let footprint = minification_footprint(difference_x.xy, difference_y.xy, ANISOTROPY);
        let variance = minification_depth_variance(footprint, gradient);
        bias = receiver_bias_depth_minified(settings, length(gradient), variance);
    }
    // The map holds a surface that leaves the light's range at the far end. The bias counts from there, since some of the
    // kernel may still see the surface within the range.
    var z = receiver.place.z;
    var step = receiver_bias_step(settings, z);
    var light = views[view].light;
    if FITTED {
        step *= fit.scale;
        z = range_fit_depth(fit, z);
        light = area_light_fitted(light, fit);
    }
    let depth = min(z, 1.0) - step;
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
        light,
        vec2f(pixel),
    ));
    return leak_reduction_apply(intensity, views[view].leak_reduction);
}

// How many texels a place lies within a view's border; negative outside.
fn view_depth(view: u32, uv: vec2f, region: MapRegion) -> f32 {
    let extent = vec2f(region.extent);
    let edges = min(uv, 1.0 - uv) * extent;
    let circle = (0.5 - distance(uv, vec2f(0.5))) * min(extent.x, extent.y);
    return select(min(edges.x, edges.y), circle, (views[view].channel & VIEW_ROUND) != 0u) - views[view].guard;
}

// Which part of a pixel a view takes, that far within its border, and which part it shades: the same, but where it fades out.
fn view_part(view: u32, depth: f32) -> vec2f {
    let border = f32(views[view].channel >> 16u) / 16.0;
    let part = select(min(depth / max(border, 0.0625), 1.0), 1.0, border == 0.0);
    return select(vec2f(max(part, 1e-6)), vec2f(1.0, part), (views[view].channel & VIEW_FADES) != 0u);
}

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let size = camera_depth_size();
    let pixel = clamp(vec2i(covered.uv * vec2f(size)), vec2i(0), size - 1);
    let stored_depth = camera_depth_at(pixel);
    // A light casts no shadow outside its map, nor where the camera sees no surface.
    var intensities = vec4f(0.0);
    if stored_depth == views[0].far_depth {
        return intensities;
    }
    let neighbours = surface_neighbours(pixel, stored_depth, views[0].far_depth, views[0].position_from_camera, views[0].scene_w_from_camera);
    // With borders, the part of each channel that no view has taken yet, and the sum of what views have taken.
    var open_channels = vec4<bool>(true);
    var left = vec4f(1.0);
    var taken = vec4f(0.0);
    for (var view = 0u; view < VIEWS; view++) {
        // A single light is in all channels, so that a host can blend with it or show it.
        let channel = vec4<bool>(LIGHTS == 1u) | vec4<bool>(vec4u(views[view].channel & 3u) == vec4u(0u, 1u, 2u, 3u));
        let region = map_region_within(views[view].region, technique_map_size());
        let receiver = receiver_at(view, pixel, stored_depth);
        let uv = receiver.place.xy;
        let from_edge = min(uv, 1.0 - uv) * vec2f(region.extent);
        var inside = receiver.light_w > 0.0 && all(from_edge >= vec2f(views[view].guard));
        if BORDERS {
            inside = inside && view_depth(view, uv, region) >= 0.0;
        }
        if inside && all(region.extent > vec2u(0u)) && any(channel & open_channels) {
            let intensity = view_shadow_intensity(view, pixel, receiver, neighbours, region);
            if BORDERS {
                let part = view_part(view, view_depth(view, uv, region));
                let share = select(vec4f(0.0), left, channel);
                intensities += share * (part.y * intensity);
                taken += share * part.x;
                left -= share * part.x;
                open_channels = left > vec4f(0.0);
            } else {
                intensities = select(intensities, vec4f(intensity), channel);
                open_channels = open_channels & !channel;
            }
        }
    }
    if BORDERS {
        // Where the last view that contains a pixel blends with none, those that contain it take all.
        return intensities / max(taken, vec4f(1e-30));
    }
    return intensities;
}
