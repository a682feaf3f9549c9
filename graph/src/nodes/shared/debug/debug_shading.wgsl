import node::camera_depth::{camera_depth_pixel_around};
import node::debug_colour::{debug_colour};
import node::fullscreen::{Covered};
import moment_shadows::map::map_region::{map_region_within};
import node::specialization::{VIEWS};
import node::surface::{surface_at};
import node::technique_map::{technique_map_size};
import node::view_list::{view_list, view_list_next};
import node::view_receiver::{border_depth, view_receiver};
import node::views::{receiver_at, views};

// How a node shades each pixel, as a colour: by the first view that contains it.

// Where there is no surface, and where no view contains one.
const NOTHING = vec4f(0.0, 0.0, 0.0, 1.0);
const NO_VIEW = vec4f(0.2, 0.2, 0.2, 1.0);

@fragment
fn debug(covered: Covered) -> @location(0) vec4f {
    let at = camera_depth_pixel_around(covered.uv);
    let pixel = at.pixel;
    let surface = surface_at(at, views[0].far_depth, views[0].position_from_camera, views[0].scene_w_from_camera);
    if surface.clip.z == views[0].far_depth {
        return NOTHING;
    }
    var list = view_list(pixel);
    for (var view = view_list_next(&list, 0u); view < VIEWS; view = view_list_next(&list, view + 1u)) {
        let region = map_region_within(views[view].region, technique_map_size());
        let receiver = receiver_at(view, surface.clip);
        if receiver.light_w > 0.0 && all(region.extent > vec2u(0u)) && border_depth(view, receiver.place.xy, region) >= 0.0 {
            return vec4f(debug_colour(view, view_receiver(view, pixel, receiver, surface, region)), 1.0);
        }
    }
    return NO_VIEW;
}
