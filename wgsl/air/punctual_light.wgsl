// Lights without an extent: directional, point and spot lights, as KHR_lights_punctual of glTF has them.

// Filled by the host-side `PunctualLight`. Positions are relative to the camera.
struct PunctualLight {
    // Where the light is; of a directional light where it travels to, with length 1.
    place: vec3f,
    // No nearer to the light does irradiance grow beyond that at this distance; 0 for a directional light.
    radius: f32,
    // The axis of a spot's cone times s, and -s times the cosine of its half angle, where s is one over the cosines' difference
    // between the inner and the outer cone. Without a cone the axis is 0 and the offset 1.
    cone_axis: vec3f,
    cone_offset: f32,
}

// Components of positions are limited, so that squares do not overflow.
const PUNCTUAL_LIGHT_FARTHEST: f32 = 1e18;

// Where light travels to at a position, with length 1 or, at the light itself, 0; and how far it has come, 0 for a
// directional light.
fn punctual_light_at(light: PunctualLight, position: vec3f) -> vec4f {
    if light.radius <= 0.0 {
        return vec4f(light.place, 0.0);
    }
    let away = clamp(position - light.place, vec3f(-PUNCTUAL_LIGHT_FARTHEST), vec3f(PUNCTUAL_LIGHT_FARTHEST));
    let distance = sqrt(dot(away, away));
    return vec4f(away / max(distance, 1e-18), distance);
}

// The part of a light that its cone lets through in a direction.
fn punctual_light_cone(light: PunctualLight, direction: vec3f) -> f32 {
    let part = saturate(dot(light.cone_axis, direction) + light.cone_offset);
    return part * part;
}

// By how much the cone is wider where rays enter and leave it, so that rounding cuts nothing off that is lit.
const PUNCTUAL_LIGHT_CONE_SLACK: f32 = 1e-3;

// The part of a ray from the camera within the light's cone, as two distances: all of it for lights without a cone, and none,
// the first distance being the larger one, where the ray passes it by.
fn punctual_light_interval(light: PunctualLight, direction: vec3f, length: f32) -> vec2f {
    let whole = vec2f(0.0, length);
    if all(light.cone_axis == vec3f(0.0)) {
        return whole;
    }
    let none = vec2f(1.0, 0.0);
    // In units in which the light is no farther away than 1, so that squares keep to what f32 holds.
    let unit = max(max(abs(light.place.x), abs(light.place.y)), max(abs(light.place.z), length));
    let place = clamp(light.place / max(unit, 1e-18), vec3f(-1.0), vec3f(1.0));
    // Inside, axis . (t direction - place) >= -offset |t direction - place|, with an offset below 0: a quadratic, where the left
    // side is positive.
    let edge = max(-light.cone_offset - PUNCTUAL_LIGHT_CONE_SLACK * sqrt(dot(light.cone_axis, light.cone_axis)), 0.0);
    let square = edge * edge;
    let rise = dot(light.cone_axis, direction);
    let first = -dot(light.cone_axis, place);
    let a = rise * rise - square;
    let half_b = rise * first + square * dot(direction, place);
    let c = first * first - square * dot(place, place);
    let discriminant = half_b * half_b - a * c;
    if discriminant < 0.0 {
        // A ray that misses both halves of the cone, or, for rounding alone, one along its side.
        return select(whole, none, a < 0.0);
    }
    // Both roots without a difference of nearly equal numbers.
    let sum = half_b + select(-1.0, 1.0, half_b >= 0.0) * sqrt(discriminant);
    let steep = -sum / select(min(a, -1e-12), max(a, 1e-12), a >= 0.0);
    let flat = -c / select(min(sum, -1e-12), max(sum, 1e-12), sum >= 0.0);
    let near = unit * min(steep, flat);
    let far = unit * max(steep, flat);
    if a < 0.0 {
        // Through one half of the cone: the lit one, if the middle of the chord lies before the light.
        let lit = first * unit + rise * (0.5 * near + 0.5 * far) > 0.0;
        return select(none, vec2f(max(near, 0.0), min(far, length)), lit);
    }
    // Through both halves, of which the lit one goes on for ever.
    return select(vec2f(0.0, min(near, length)), vec2f(max(far, 0.0), length), rise > 0.0);
}
