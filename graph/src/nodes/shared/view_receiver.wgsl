import node::camera_depth::{CameraSurface, camera_depth_size};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_axes, minification_axes_depth_variance};
import moment_shadows::map::range_fit::{range_fit_depth, range_fit_none};
import moment_shadows::shade::area_light::{area_light_fitted};
import moment_shadows::shade::receiver_bias::{RECEIVER_BIAS_EDGE_ON, receiver_bias_depth, receiver_bias_depth_minified, receiver_bias_fitted, receiver_bias_step};
import moment_shadows::shade::view_border::{view_border_depth};
import node::range_of_view::{range_of_view};
import node::specialization::{ANISOTROPY, FITTED, LEVELS};
import node::technique_receiver::{TechniqueReceiver};
import node::views::{Receiver, VIEW_ROUND, views};

// What a technique is told about a pixel's surface.

// No place in the map is that many texels away. Products of two differences must not overflow.
const LARGEST_DIFFERENCE: f32 = 1e9;

// How the place in the map and the moment depth change with a coordinate of clip space, each times what it is divided by.
// With numerators n and divisors w, d(n / w) = (dn - (n / w) dw) / w. Unlike a difference of two places, this keeps its digits
// where a pixel covers a small part of a texel.
fn receiver_change(view: u32, coordinate: u32, receiver: Receiver) -> vec3f {
    let light = views[view].light_from_camera[coordinate];
    return light.xyw - receiver.place * vec3f(light.zz, views[view].scene_w_from_camera[coordinate]);
}

// How moment depth changes per texel on a surface.
struct ReceiverSlope {
    gradient: vec2f,
    // Its length.
    steepness: f32,
}

// From the changes along x and y of the screen. Where the surface's plane is edge-on to the light, or unknown, it is huge, and what is made of it is limited.
fn receiver_slope(x: vec3f, y: vec3f, receiver: Receiver, texels: vec2f, has_plane: bool) -> ReceiverSlope {
    let normal = cross(x, y);
    let across = normal.xy * texels.yx;
    let facing = normal.z * (texels.x * texels.y);
    let scale = receiver.light_w * receiver.per_scene_w / max(abs(facing), SMALLEST_FACING);
    let gradient = select(across, -across, facing >= 0.0) * scale;
    let limited = clamp(gradient, vec2f(-RECEIVER_BIAS_EDGE_ON), vec2f(RECEIVER_BIAS_EDGE_ON));
    let steepness = min(length(across) * scale, RECEIVER_BIAS_EDGE_ON);
    return ReceiverSlope(select(vec2f(RECEIVER_BIAS_EDGE_ON, 0.0), limited, has_plane), select(RECEIVER_BIAS_EDGE_ON, steepness, has_plane));
}

// Of a normal that is edge-on to the light nothing but rounding is left along its rays.
const SMALLEST_FACING: f32 = 1e-20;

// How many texels a pixel covers that is a step of `screen` wide in clip space.
fn receiver_difference(change: vec3f, receiver: Receiver, texels: vec2f, screen: f32, has_plane: bool) -> vec2f {
    let difference = change.xy * texels * (screen * receiver.per_light_w);
    return select(vec2f(0.0), clamp(difference, vec2f(-LARGEST_DIFFERENCE), vec2f(LARGEST_DIFFERENCE)), has_plane);
}

// A pixel's surface, which a view contains, as techniques take it.
fn view_receiver(view: u32, pixel: vec2i, receiver: Receiver, surface: CameraSurface, region: MapRegion) -> TechniqueReceiver {
    let texels = vec2f(region.extent);
    let along = receiver_change(view, 2u, receiver);
    let x = receiver_change(view, 0u, receiver) + surface.slope.x * along;
    let y = receiver_change(view, 1u, receiver) + surface.slope.y * along;
    var slope = receiver_slope(x, y, receiver, texels, surface.has_plane);
    // To the pixels beside and below.
    let screen = vec2f(2.0, -2.0) / vec2f(camera_depth_size());
    let difference_x = receiver_difference(x, receiver, texels, screen.x, surface.has_plane);
    let difference_y = receiver_difference(y, receiver, texels, screen.y, surface.has_plane);
    // All that is a moment depth, or a difference of two, becomes one of the map's range.
    var fit = range_fit_none();
    var settings = views[view].receiver_bias;
    if FITTED {
        fit = range_of_view(views[view].layer, region.origin);
        slope.gradient *= fit.scale;
        slope.steepness *= fit.scale;
        settings = receiver_bias_fitted(settings, fit.scale);
    }
    var bias = receiver_bias_depth(settings, slope.steepness);
    if LEVELS > 1u {
        let axes = minification_axes(difference_x, difference_y, ANISOTROPY);
        let variance = minification_axes_depth_variance(axes, slope.gradient);
        bias = receiver_bias_depth_minified(settings, slope.steepness, variance);
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
        difference_x,
        difference_y,
        slope.gradient,
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
