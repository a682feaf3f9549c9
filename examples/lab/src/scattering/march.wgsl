import node::scattering_view::{view, view_cosine, view_dimming, view_surface};
import moment_shadows::air::single_scattering::{single_scattering_ray};

// In-scattered radiance by marching: a load of the plain depth map at the middle of each step, everything else in closed form. Pixels of the
// target are every so many pixels of the picture.

@group(0) @binding(2) var light_depth: texture_depth_2d;

override STEPS: u32 = 16;
override PIXELS: i32 = 1;
// Whether steps are shifted from pixel to pixel, as renderers do that blur the result.
override DITHERED: bool = false;

// Whether a moment depth is in shadow at a place of the map; outside of it nothing is.
fn visibility_shadow(uv: vec2f, depth: f32) -> f32 {
    let size = vec2f(textureDimensions(light_depth));
    let inside = all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
    let texel = vec2i(min(saturate(uv) * size, size - 1.0));
    let stored = textureLoad(light_depth, texel, 0);
    // The lab's directional lights store depth from 0 to 1; 1 means no caster.
    return select(0.0, 1.0, inside && stored < 1.0 && fma(2.0, stored, -1.0) < depth);
}

// Interleaved gradient noise (Jimenez, "Next generation post processing in Call of Duty", SIGGRAPH 2014).
fn dither(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

@fragment
fn march(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let surface = view_surface(vec2i(position.xy) * PIXELS);
    let distance = length(surface);
    let step = distance / f32(STEPS);
    let through = exp(-view.medium.extinction * step);
    let uv_change = surface.x * view.map_along_first + surface.y * view.map_along_second;
    let depth_change = surface.z * view.depth_per_length;
    let offset = select(0.5, dither(position.xy), DITHERED);
    var before = vec3f(1.0);
    var lit = vec3f(0.0);
    for (var index = 0u; index < STEPS; index++) {
        let part = (f32(index) + offset) / f32(STEPS);
        let uv = fma(vec2f(part), uv_change, view.map_at_camera);
        let shadow = visibility_shadow(uv, fma(part, depth_change, view.depth_at_camera));
        lit = fma(vec3f(1.0 - shadow), before, lit);
        before *= through;
    }
    let cosine = view_cosine(surface);
    let radiance = single_scattering_ray(view.medium, step, cosine, 0.0).radiance * lit;
    return vec4f(radiance, view_dimming(single_scattering_ray(view.medium, distance, cosine, 0.0).transmittance));
}
