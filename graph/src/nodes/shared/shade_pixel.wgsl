import node::camera_depth::{CameraPixel, CameraSurface};
import moment_shadows::shade::leak_reduction::{leak_reduction_apply};
import moment_shadows::map::map_region::{MapRegion, map_region_within};
import moment_shadows::shade::view_border::{view_border_parts};
import node::specialization::{LIGHTS, TARGETS, VIEWS};
import node::surface::{surface_at};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::view_list::{view_list, view_list_next};
import node::view_receiver::{border_depth, view_receiver};
import node::views::{Receiver, VIEW_FADES, receiver_at, views};

// Shadow intensity of a pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target, or of one of several.

// Whether borders count; otherwise they are sharp.
override BORDERS: bool = false;

// Which part of a pixel a view takes, that far within its border, and which part it shades.
fn border_parts(view: u32, depth: f32) -> vec2f {
    let channel = views[view].channel;
    return view_border_parts(depth, f32(channel >> 16u) / 16.0, (channel & VIEW_FADES) != 0u);
}

// Whether the region of a view contains a surface, its border aside.
fn region_contains(view: u32, receiver: Receiver, region: MapRegion) -> bool {
    let texels = vec2f(region.extent);
    let place = receiver.place.xy * texels;
    let from_edge = min(place, texels - place);
    return (receiver.light_w > 0.0) & (min(from_edge.x, from_edge.y) >= views[view].guard) & all(region.extent > vec2u(0u));
}

// The first view that contains a surface; VIEWS where none does.
fn first_view(listed: vec2i, clip: vec4f) -> u32 {
    var list = view_list(listed);
    for (var view = view_list_next(&list, 0u); view < VIEWS; view = view_list_next(&list, view + 1u)) {
        if region_contains(view, receiver_at(view, clip), map_region_within(views[view].region, technique_map_size())) {
            return view;
        }
    }
    return VIEWS;
}

// The shadow of a single light with sharp borders: one lookup, in the first view that contains the surface.
fn shade_single(pixel: vec2i, listed: vec2i, surface: CameraSurface) -> f32 {
    var view = 0u;
    if VIEWS > 1u {
        view = first_view(listed, surface.clip);
        if view >= VIEWS {
            return 0.0;
        }
    }
    let region = map_region_within(views[view].region, technique_map_size());
    let receiver = receiver_at(view, surface.clip);
    if VIEWS == 1u && !region_contains(view, receiver, region) {
        return 0.0;
    }
    let bound = technique_shadow_intensity(view_receiver(view, pixel, receiver, surface, region));
    return leak_reduction_apply(bound, views[view].leak_reduction);
}

// The shadow intensity in each target. `listed` is a pixel of the same tile: where a workgroup has one, all its invocations go through the same views.
fn shade_pixel(at: CameraPixel, listed: vec2i) -> array<vec4f, TARGETS> {
    let pixel = at.pixel;
    let surface = surface_at(at, views[0].far_depth, views[0].position_from_camera, views[0].scene_w_from_camera);
    // A light casts no shadow outside its map, nor where the camera sees no surface.
    var intensities: array<vec4f, TARGETS>;
    if surface.clip.z == views[0].far_depth {
        return intensities;
    }
    // A single light is in all channels, so that a host can blend with it or show it.
    if LIGHTS == 1u && !BORDERS {
        intensities[0] = vec4f(shade_single(pixel, listed, surface));
        return intensities;
    }
    // The lights that some view may still shade, a bit for each. With borders, the part of each channel that no view has taken yet, and
    // the sum of what views have taken.
    var open_lights = 0xffffu;
    var left: array<vec4f, TARGETS>;
    var taken: array<vec4f, TARGETS>;
    if BORDERS {
        for (var four = 0u; four < TARGETS; four++) {
            left[four] = vec4f(1.0);
        }
    }
    var list = view_list(listed);
    for (var view = view_list_next(&list, 0u); view < VIEWS; view = view_list_next(&list, view + 1u)) {
        // A single light is in all channels, so that a host can blend with it or show it.
        let light = select(views[view].channel & 15u, 0u, LIGHTS == 1u);
        // Shaded by a view before.
        if (open_lights & (1u << light)) == 0u {
            continue;
        }
        let region = map_region_within(views[view].region, technique_map_size());
        let receiver = receiver_at(view, surface.clip);
        let uv = receiver.place.xy;
        var inside = region_contains(view, receiver, region);
        if BORDERS {
            inside = inside && border_depth(view, uv, region) >= 0.0;
        }
        if inside {
            let bound = technique_shadow_intensity(view_receiver(view, pixel, receiver, surface, region));
            let intensity = leak_reduction_apply(bound, views[view].leak_reduction);
            var is_open = false;
            var part = vec2f(1.0);
            if BORDERS {
                part = border_parts(view, border_depth(view, uv, region));
            }
            for (var four = 0u; four < TARGETS; four++) {
                let channel = vec4<bool>(LIGHTS == 1u) | (vec4u(light) == 4u * four + vec4u(0u, 1u, 2u, 3u));
                if BORDERS {
                    let share = select(vec4f(0.0), left[four], channel);
                    intensities[four] += share * (part.y * intensity);
                    taken[four] += share * part.x;
                    left[four] -= share * part.x;
                    is_open = is_open || any(channel & (left[four] > vec4f(0.0)));
                } else {
                    intensities[four] = select(intensities[four], vec4f(intensity), channel);
                }
            }
            if !is_open {
                open_lights &= ~(1u << light);
            }
        }
    }
    if BORDERS {
        // Where the last view that contains a pixel blends with none, those that contain it take all.
        for (var four = 0u; four < TARGETS; four++) {
            intensities[four] /= max(taken[four], vec4f(1e-30));
        }
    }
    return intensities;
}
