import node::camera_depth::{camera_depth_pixel};
import node::fullscreen::{Covered};
import moment_shadows::shade::leak_reduction::{leak_reduction_apply};
import moment_shadows::map::map_region::{map_region_within};
import moment_shadows::shade::view_border::{view_border_parts};
import node::specialization::{LIGHTS, VIEWS};
import node::surface::{surface_at};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::view_list::{view_list_next};
import node::view_receiver::{border_depth, view_receiver};
import node::views::{VIEW_FADES, receiver_at, views};

// Shadow intensity of every pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target, or of one of several.

// Whether borders count; otherwise they are sharp.
override BORDERS: bool = false;
// The light of the target's first channel.
override FIRST_LIGHT: u32 = 0u;

// Which part of a pixel a view takes, that far within its border, and which part it shades.
fn border_parts(view: u32, depth: f32) -> vec2f {
    let channel = views[view].channel;
    return view_border_parts(depth, f32(channel >> 16u) / 16.0, (channel & VIEW_FADES) != 0u);
}

// The first view that contains a surface; VIEWS where none does.
fn first_view(pixel: vec2i, clip: vec4f) -> u32 {
    for (var view = view_list_next(pixel, 0u); view < VIEWS; view = view_list_next(pixel, view + 1u)) {
        let region = map_region_within(views[view].region, technique_map_size());
        let light = views[view].light_from_camera * clip;
        let from_edge = min(light.xy, light.z - light.xy) * vec2f(region.extent);
        if (light.z > 0.0) & (min(from_edge.x, from_edge.y) >= views[view].guard * light.z) & all(region.extent > vec2u(0u)) {
            return view;
        }
    }
    return VIEWS;
}

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let pixel = camera_depth_pixel(covered.uv);
    let surface = surface_at(covered.uv, views[0].position_from_camera, views[0].scene_w_from_camera);
    // A light casts no shadow outside its map, nor where the camera sees no surface.
    var intensities = vec4f(0.0);
    if surface.clip.z == views[0].far_depth {
        return intensities;
    }
    if LIGHTS == 1u && VIEWS > 1u && !BORDERS {
        // One lookup, in the first view that contains the surface.
        let view = first_view(pixel, surface.clip);
        if view < VIEWS {
            let region = map_region_within(views[view].region, technique_map_size());
            let receiver = receiver_at(view, surface.clip);
            let bound = technique_shadow_intensity(view_receiver(view, pixel, receiver, surface, region));
            return vec4f(leak_reduction_apply(bound, views[view].leak_reduction));
        }
        return intensities;
    }
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
        let receiver = receiver_at(view, surface.clip);
        let uv = receiver.place.xy;
        let texels = vec2f(region.extent);
        let from_edge = min(uv * texels, texels - uv * texels);
        var inside = (receiver.light_w > 0.0) & (min(from_edge.x, from_edge.y) >= views[view].guard) & all(region.extent > vec2u(0u));
        if BORDERS {
            inside = inside && border_depth(view, uv, region) >= 0.0;
        }
        if inside {
            let bound = technique_shadow_intensity(view_receiver(view, pixel, receiver, surface, region));
            let intensity = leak_reduction_apply(bound, views[view].leak_reduction);
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
