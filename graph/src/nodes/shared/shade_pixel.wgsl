import node::camera_depth::{camera_depth_at, camera_depth_size};
import moment_shadows::shade::leak_reduction::{leak_reduction_apply};
import moment_shadows::map::map_region::{map_region_within};
import moment_shadows::shade::view_border::{view_border_parts};
import node::specialization::{LIGHTS, TARGETS, VIEWS};
import node::surface::{surface_neighbours};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::view_list::{view_list, view_list_next};
import node::view_receiver::{border_depth, view_receiver};
import node::views::{VIEW_FADES, receiver_at, views};

// Shadow intensity of a pixel, from the camera's depth and a light's map, by the technique of the map. A view of a light is one region of one
// layer: a sun's cascade, a face of a point light, a spot light. Each light has a channel of the target, or of one of several.

// Whether borders count; otherwise they are sharp.
override BORDERS: bool = false;

// Which part of a pixel a view takes, that far within its border, and which part it shades.
fn border_parts(view: u32, depth: f32) -> vec2f {
    let channel = views[view].channel;
    return view_border_parts(depth, f32(channel >> 16u) / 16.0, (channel & VIEW_FADES) != 0u);
}

// The shadow intensity in each target. `listed` is a pixel of the same tile: where a workgroup has one, all its invocations go through the same views.
fn shade_pixel(pixel: vec2i, listed: vec2i) -> array<vec4f, TARGETS> {
    let stored_depth = camera_depth_at(pixel);
    // A light casts no shadow outside its map, nor where the camera sees no surface.
    var intensities: array<vec4f, TARGETS>;
    if stored_depth == views[0].far_depth {
        return intensities;
    }
    let neighbours = surface_neighbours(pixel, stored_depth, views[0].far_depth, views[0].position_from_camera, views[0].scene_w_from_camera);
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
        let receiver = receiver_at(view, pixel, stored_depth);
        let uv = receiver.place.xy;
        let from_edge = min(uv, 1.0 - uv) * vec2f(region.extent);
        var inside = receiver.light_w > 0.0 && all(from_edge >= vec2f(views[view].guard));
        if BORDERS {
            inside = inside && border_depth(view, uv, region) >= 0.0;
        }
        if inside && all(region.extent > vec2u(0u)) {
            let bound = technique_shadow_intensity(view_receiver(view, pixel, receiver, neighbours, region));
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
