import moment_shadows::air::height_fog::{height_fog_thickness};
import moment_shadows::air::march::{March, march_begin, march_falloff, march_place, march_step, march_steps, march_thickness, march_transmittance};
import moment_shadows::air::phase_function::{phase_function_henyey_greenstein};
import moment_shadows::air::punctual_light::{punctual_light_at, punctual_light_cone, punctual_light_interval};
import moment_shadows::air::single_scattering::{SingleScatteringRay, single_scattering_pixel};
import moment_shadows::air::view_ray::{ViewRay, view_ray_of_pixel};
import moment_shadows::maths::blue_noise::{blue_noise_offset};
import node::air_shadow::{air_shadow};
import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel, camera_depth_size};
import node::density::{density};
import node::fullscreen::{Covered};
import node::march_views::{views};
import node::specialization::{DITHERED, OWN_DENSITY, PER_TEXEL, STEPS};

// Radiance that a medium scatters into the view ray of every pixel, or of every so many, marched.

// The optical thickness per extinction of a stretch of a ray, which has the density of one of its points.
fn stretch_thickness(ray: ViewRay, start: f32, length: f32, point: f32) -> f32 {
    let fog = height_fog_thickness(views[0].fog, start * ray.direction, ray.direction, length);
    if OWN_DENSITY {
        return march_thickness(density(views[0].eye + point * ray.direction, views[0].own), fog);
    }
    return fog;
}

@fragment
fn march(covered: Covered) -> @location(0) vec4f {
    let picture = vec2u(camera_depth_size());
    let target_size = (picture + PER_TEXEL - 1u) / PER_TEXEL;
    let texel = vec2u(floor(covered.uv * vec2f(target_size)));
    // The pixel in its middle.
    let pixel = min(texel * PER_TEXEL + PER_TEXEL / 2u, picture - 1u);
    let clip = camera_depth_clip(camera_depth_pixel(vec2i(pixel)), camera_depth_at(vec2i(pixel)));
    let ray = view_ray_of_pixel(views[0].position_from_camera, views[0].scene_w_from_camera, views[0].farthest_w, clip);
    let medium = views[0].medium;
    let light = views[0].light;

    var interval = vec2f(0.0, ray.length);
    if !OWN_DENSITY {
        // What lies before and behind a cone is known in closed form.
        interval = punctual_light_interval(light, ray.direction, ray.length);
    }
    let whole = height_fog_thickness(views[0].fog, vec3f(0.0), ray.direction, ray.length);
    let before = height_fog_thickness(views[0].fog, vec3f(0.0), ray.direction, max(interval.x, 0.0));
    var gathered = march_begin();
    gathered.transmittance = march_transmittance(medium, before);

    var offset = 0.5;
    if DITHERED {
        offset = blue_noise_offset(texel, views[0].offset);
    }
    let steps = march_steps(light, ray.direction, interval);
    let count = select(f32(STEPS), 0.0, interval.y <= interval.x);
    var start = steps.first;
    for (var step = 0.0; step < count; step += 1.0) {
        let point = march_place(steps, (step + offset) / count);
        let end = march_place(steps, (step + 1.0) / count);
        let length = max(end - start, 0.0);
        let thickness = stretch_thickness(ray, start, length, point);
        start = end;
        // What changes gently is that of the step's middle, so that dithering makes no noise of it.
        let middle = march_place(steps, (step + 0.5) / count) * ray.direction;
        let at = punctual_light_at(light, middle);
        let part = punctual_light_cone(light, at.xyz) * march_falloff(steps, light.radius, length, count);
        let lit = part * (1.0 - air_shadow(point * ray.direction, length * ray.direction, vec2f(pixel)));
        let phase = phase_function_henyey_greenstein(-dot(at.xyz, ray.direction), medium.anisotropy);
        // Fog dims a light with a position on its way, too.
        let way = march_transmittance(medium, height_fog_thickness(views[0].fog, middle, -at.xyz, at.w));
        gathered = march_step(gathered, medium, thickness, (lit * phase) * medium.irradiance * way);
    }
    var transmittance = march_transmittance(medium, whole);
    if OWN_DENSITY {
        transmittance = gathered.transmittance;
    }
    return single_scattering_pixel(SingleScatteringRay(gathered.radiance, transmittance));
}
