import node::camera_depth::{camera_depth_at, camera_depth_size};
import node::fullscreen::{Covered};
import moment_shadows::shade::leak_reduction::{leak_reduction_apply};
import moment_shadows::map::map_region::{MapRegion, map_region_within};
import moment_shadows::map::minification::{minification_depth_variance, minification_footprint};
import moment_shadows::map::range_fit::{range_fit_depth, range_fit_none};
import moment_shadows::shade::area_light::{area_light_fitted};
import moment_shadows::shade::receiver_bias::{receiver_bias_depth, receiver_bias_depth_minified, receiver_bias_fitted, receiver_bias_plane, receiver_bias_step};
import moment_shadows::shade::view_border::{view_border_depth, view_border_parts};
import node::range_of_view::{range_of_view};
import node::specialization::{ANISOTROPY, FITTED, LEVELS, LIGHTS, VIEWS};
import node::surface::{surface_neighbours};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::technique_receiver::{TechniqueReceiver};
import node::view_list::{view_list_next};
import node::views::{Receiver, VIEW_FADES, VIEW_ROUND, receiver_at, views};

// Shadow intensity of every pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target, or of one of several.

// Whether borders count; otherwise they are sharp.
override BORDERS: bool = false;
// The light of the target's first channel.
override FIRST_LIGHT: u32 = 0u;

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
fn border_depth(view: u32, uv: vec2f, region: MapRegion) -> f32 {
    return view_border_depth(uv, vec2f(region.extent), views[view].guard, (views[view].channel & VIEW_ROUND) != 0u);
}

// Which part of a pixel a view takes, that far within its border, and which part it shades.
fn border_parts(view: u32, depth: f32) -> vec2f {
    let channel = views[view].channel;
    return view_border_parts(depth, f32(channel >> 16u) / 16.0, (channel & VIEW_FADES) != 0u);
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
    for (var view = view_list_next(pixel, 0u); view < VIEWS; view = view_list_next(pixel, view + 1u)) {
        // A single light is in all channels, so that a host can blend with it or show it.
        let channel = vec4<bool>(LIGHTS == 1u) | (vec4u(views[view].channel & 15u) == FIRST_LIGHT + vec4u(0u, 1u, 2u, 3u));
        // Of another target, or shaded by a view before.
        if !any(channel & open_channels) {
            continue;
        }
        let region = map_region_within(views[view].region, technique_map_size());
        let receiver = receiver_at(view, pixel, stored_depth);
        let uv = receiver.place.xy;
        let from_edge = min(uv, 1.0 - uv) * vec2f(region.extent);
        var inside = receiver.light_w > 0.0 && all(from_edge >= vec2f(views[view].guard));
        if BORDERS {
            inside = inside && border_depth(view, uv, region) >= 0.0;
        }
        if inside && all(region.extent > vec2u(0u)) {
            let intensity = view_shadow_intensity(view, pixel, receiver, neighbours, region);
            if BORDERS {
                let part = border_parts(view, border_depth(view, uv, region));
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
