import node::camera_depth::{camera_depth_size};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_depth_variance, minification_footprint};
import moment_shadows::map::range_fit::{range_fit_depth, range_fit_none};
import moment_shadows::shade::area_light::{area_light_fitted};
import moment_shadows::shade::receiver_bias::{receiver_bias_depth, receiver_bias_depth_minified, receiver_bias_fitted, receiver_bias_plane, receiver_bias_step};
import moment_shadows::shade::view_border::{view_border_depth};
import node::range_of_view::{range_of_view};
import node::specialization::{ANISOTROPY, FITTED, LEVELS};
import node::technique_receiver::{TechniqueReceiver};
import node::views::{Receiver, VIEW_ROUND, views};

// What a technique is told about a pixel's surface.

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

// A pixel's surface, which a view contains, as techniques take it.
fn view_receiver(view: u32, pixel: vec2i, receiver: Receiver, neighbours: mat2x3f, region: MapRegion) -> TechniqueReceiver {
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
    return TechniqueReceiver(
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
    );
}

// How many texels a place lies within a view's border; negative outside.
fn border_depth(view: u32, uv: vec2f, region: MapRegion) -> f32 {
    return view_border_depth(uv, vec2f(region.extent), views[view].guard, (views[view].channel & VIEW_ROUND) != 0u);
}
