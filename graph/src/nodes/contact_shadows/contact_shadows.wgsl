import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel, camera_depth_pixel_around, camera_depth_size};
import node::fullscreen::{Covered};
import node::intensity::{intensity_at};
import moment_shadows::shade::contact_shadow::{ContactShadowParameters, contact_shadow_hides, contact_shadow_intensity, contact_shadow_nearer, contact_shadow_place, contact_shadow_ray};
import node::specialization::{CAMERA_SAMPLE, DEPTH_STEP, GROUP, LIGHTS, STEPS};
import node::surface::{surface_at};

// The shadow of every pixel at contacts, from the camera's depth, where it is darker than what maps say.

@group(GROUP) @binding(0) var<uniform> lights: array<ContactShadowParameters, LIGHTS>;

// The shadow of a light on a pixel's surface in clip space, whose stored depth changes by `slope` from pixel to pixel.
fn march(light: u32, surface: vec4f, slope: vec2f) -> f32 {
    let last = camera_depth_size() - 1;
    let ray = contact_shadow_ray(lights[light], surface, vec2f(last + 1), f32(STEPS));
    for (var step = 0.5; step < ray.steps; step += 1.0) {
        let along = step / ray.steps;
        let place = contact_shadow_place(ray, along);
        let pixel = clamp(vec2i(floor(place.xy - CAMERA_SAMPLE + 0.5)), vec2i(0), last);
        // Depth is known at pixels' samples. The ray moves there along the receiver's plane, so that a plane does not hide its own ray at
        // any angle; but not away from the camera, into a wall that stands on the plane half a pixel farther on.
        let moved = place.z + dot(slope, vec2f(pixel) + CAMERA_SAMPLE - place.xy);
        let nearer = contact_shadow_nearer(lights[light], vec2f(place.z, moved));
        let clip = camera_depth_clip(camera_depth_pixel(pixel), nearer);
        if contact_shadow_hides(lights[light], clip, camera_depth_at(pixel), DEPTH_STEP) {
            return contact_shadow_intensity(ray, along);
        }
    }
    return 0.0;
}

@fragment
fn contact(covered: Covered) -> @location(0) vec4f {
    let at = camera_depth_pixel_around(covered.uv);
    let pixel = at.pixel;
    let surface = surface_at(at, lights[0].far_depth, lights[0].position_from_camera, lights[0].scene_w_from_camera);
    var intensities = intensity_at(pixel);
    if surface.clip.z == lights[0].far_depth {
        return intensities;
    }
    // From pixel to pixel.
    let slope = surface.slope * vec2f(2.0, -2.0) / vec2f(camera_depth_size());
    for (var light = 0u; light < LIGHTS; light++) {
        // A single light is in all channels, as the nodes that shade have it.
        let channel = vec4<bool>(LIGHTS == 1u) | (vec4u(light) == vec4u(0u, 1u, 2u, 3u));
        // Full shadow does not become darker.
        if any(channel & (intensities < vec4f(1.0))) {
            intensities = select(intensities, max(intensities, vec4f(march(light, surface.clip, slope))), channel);
        }
    }
    return intensities;
}
