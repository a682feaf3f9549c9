import moment_shadows::map::map_region::{map_region_within};
import moment_shadows::map::range_fit::{range_fit_depth};
import moment_shadows::shade::area_light::{AreaLight};
import moment_shadows::shade::leak_reduction::{leak_reduction_apply};
import node::march_views::{views};
import node::range_of_view::{range_of_view};
import node::specialization::{FITTED, LEVELS, VIEWS};
import node::technique::{technique_shadow_intensity};
import node::technique_map::{technique_map_size};
import node::technique_receiver::{TechniqueReceiver};

// The shadow of a point in the air: one lookup in the first view that contains it. Nothing casts a shadow on itself there, so that
// no bias is needed.

// No place in the map is that many texels away.
const LARGEST_DIFFERENCE: f32 = 1e9;

struct ViewShadow {
    // Whether the view contains the point.
    inside: bool,
    intensity: f32,
}

// What a view says of the point; lit where it does not contain it.
fn view_shadow(view: u32, position: vec3f, stretch: vec3f, pixel: vec2f) -> ViewShadow {
    let place = views[view].map_from_position * vec4f(position, 1.0);
    let region = map_region_within(views[view].region, technique_map_size());
    let texels = vec2f(region.extent);
    let per_z = 1.0 / max(place.z, 1e-30);
    let uv = place.xy * per_z;
    let from_edge = min(uv * texels, texels - uv * texels);
    let inside = (place.z > 0.0) & (min(from_edge.x, from_edge.y) >= views[view].guard) & all(region.extent > vec2u(0u));
    if !inside {
        return ViewShadow(false, 0.0);
    }
    var z = place.w;
    if FITTED {
        z = range_fit_depth(range_of_view(views[view].layer, region.origin), z);
    }
    var difference = vec2f(0.0);
    if LEVELS > 1u {
        let change = views[view].map_from_position * vec4f(stretch, 0.0);
        let moved = (change.xy - uv * change.z) * per_z * texels;
        difference = clamp(moved, vec2f(-LARGEST_DIFFERENCE), vec2f(LARGEST_DIFFERENCE));
    }
    let conversion = views[view].conversion;
    // Techniques take what lies beyond the light's range for its end.
    let receiver = TechniqueReceiver(views[view].layer, region, uv, difference, vec2f(0.0), vec2f(0.0), z, z, 1.0, conversion, AreaLight(), pixel);
    return ViewShadow(true, leak_reduction_apply(technique_shadow_intensity(receiver), views[view].leak_reduction));
}

// The shadow intensity at a position relative to the camera, over a stretch of a ray around it: a map with mip levels is filtered
// over that. What the light's map does not know casts no shadow.
fn air_shadow(position: vec3f, stretch: vec3f, pixel: vec2f) -> f32 {
    if VIEWS == 1u {
        return view_shadow(0u, position, stretch, pixel).intensity;
    }
    for (var view = 0u; view < VIEWS; view++) {
        let shadow = view_shadow(view, position, stretch, pixel);
        if shadow.inside {
            return shadow.intensity;
        }
    }
    return 0.0;
}
