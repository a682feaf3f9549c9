// Contact shadows: a ray from a pixel's surface towards a light is followed through the camera's depth for a short way, where maps lose the
// shadow at the feet of what casts it (screen-space ray tracing: McGuire & Mara, JCGT 3(4) 2014).
//
// The ray is a line in clip space, so on the screen it is straight and its stored depth is linear along it, whatever the projection. A
// surface hides the ray where the ray lies behind it by less than the surface is thick, measured along the camera's axis. The camera sees no
// backs, so thickness is a guess, and what the picture does not show casts no such shadow.

// Filled by the host-side `ContactShadowParameters`, one for each light.
struct ContactShadowParameters {
    // Parallel rays: how the camera's clip coordinates change per scene unit towards the light. Other lights: their clip coordinates.
    light_clip: vec4f,
    // The light's position relative to the camera, and 1; zeros for parallel rays.
    light_position: vec4f,
    // By rows, the scene position relative to the camera, times the homogeneous coordinate that `scene_w_from_camera` gives.
    position_from_camera: mat3x4f,
    scene_w_from_camera: vec4f,
    // The difference of two distances along the camera's axis is this times that of their stored depths, divided by both
    // homogeneous coordinates.
    depth_scale: f32,
    // How far rays go and how thick surfaces are, in scene units; a light without length has no such shadows.
    length: f32,
    thickness: f32,
    // The stored depth of pixels that show no surface; the same for all lights.
    far_depth: f32,
}

// A ray on the screen, as far as it stays there.
struct ContactShadowRay {
    // Where it begins, and the way to its end: x and y in pixels, z in stored depth.
    start: vec3f,
    way: vec3f,
    // How many steps it takes: none is shorter than a pixel.
    steps: f32,
    // The homogeneous coordinate at its end; 1 where it begins.
    end_w: f32,
    // Its part of the full length.
    reach: f32,
}

// No ray comes nearer to the camera than this part of the distance from which it begins.
const CONTACT_SHADOW_NEAREST: f32 = 0.0625;

// The part of the length at whose end shadows have faded out.
const CONTACT_SHADOW_FADE: f32 = 0.25;

// How many steps of stored depth a ray has to lie behind a surface: both depths are off by a step, and the slope between two pixels by
// two halves.
const CONTACT_SHADOW_DEPTH_STEPS: f32 = 4.0;

// And which part of the thickness: surfaces are not quite plane from pixel to pixel.
const CONTACT_SHADOW_BIAS: f32 = 0.02;

// The ray from a surface in clip space, (x, y, stored depth, 1), on a screen of `size` pixels.
fn contact_shadow_ray(parameters: ContactShadowParameters, clip: vec4f, size: vec2f, most_steps: f32) -> ContactShadowRay {
    let scene_w = max(dot(parameters.scene_w_from_camera, clip), 0.0);
    let position = clip * parameters.position_from_camera / max(scene_w, 1e-30);
    let is_parallel = parameters.light_position.w == 0.0;
    let distance = select(length(parameters.light_position.xyz - position), 1.0, is_parallel);
    let full = select(min(parameters.length, distance), parameters.length, is_parallel);
    // A scene position in clip space is `clip` divided by `scene_w`, which is multiplied out.
    let towards = scene_w * parameters.light_clip - select(clip, vec4f(0.0), is_parallel);
    let whole = towards * (full / max(distance, 1e-30));
    // Signed distances from the edges of the screen, and how they change.
    let inside = max(vec4f(1.0 + clip.xy, 1.0 - clip.xy), vec4f(0.0));
    let change = vec4f(whole.w + whole.xy, whole.w - whole.xy);
    let leaves = select(vec4f(1.0), inside / max(-change, vec4f(1e-30)), change < vec4f(0.0));
    let nears = select(1.0, (1.0 - CONTACT_SHADOW_NEAREST) / max(-whole.w, 1e-30), whole.w < 0.0);
    let part = min(min(min(leaves.x, leaves.y), min(leaves.z, leaves.w)), min(nears, 1.0));
    let end_w = max(1.0 + part * whole.w, CONTACT_SHADOW_NEAREST);
    let end = (clip.xyz + part * whole.xyz) / end_w;
    let scale = vec3f(0.5 * size.x, -0.5 * size.y, 1.0);
    let way = (end - clip.xyz) * scale;
    let steps = clamp(floor(max(abs(way.x), abs(way.y))), 0.0, most_steps);
    let start = clip.xyz * scale + vec3f(0.5 * size, 0.0);
    return ContactShadowRay(start, way, steps, end_w, part * full / max(parameters.length, 1e-30));
}

// Where a ray is, from its start at 0 to its end at 1: x and y in pixels, z in stored depth.
fn contact_shadow_place(ray: ContactShadowRay, along: f32) -> vec3f {
    return ray.start + along * ray.way;
}

// The stored depth that is nearer to the camera.
fn contact_shadow_nearer(parameters: ContactShadowParameters, stored: vec2f) -> f32 {
    return select(min(stored.x, stored.y), max(stored.x, stored.y), parameters.depth_scale < 0.0);
}

// Whether a surface, by its stored depth, hides a place in clip space, (x, y, stored depth, 1), on the same view ray. `depth_step` is by how much
// stored depth is rounded.
fn contact_shadow_hides(parameters: ContactShadowParameters, place: vec4f, stored_depth: f32, depth_step: f32) -> bool {
    let place_w = dot(parameters.scene_w_from_camera, place);
    let surface_w = dot(parameters.scene_w_from_camera, vec4f(place.xy, stored_depth, 1.0));
    // All lengths are multiplied by both, so that nothing is divided by what may be 0 at an infinite distance.
    let divisor = max(place_w, 0.0) * max(surface_w, 0.0);
    let behind = parameters.depth_scale * (place.z - stored_depth);
    let thickness = parameters.thickness * divisor;
    let bias = CONTACT_SHADOW_BIAS * thickness + abs(parameters.depth_scale) * CONTACT_SHADOW_DEPTH_STEPS * depth_step;
    return behind > bias && behind < thickness;
}

// The shadow of a surface that hides the ray there: it fades out towards the full length, so that there is no line.
fn contact_shadow_intensity(ray: ContactShadowRay, along: f32) -> f32 {
    // Parts of the screen are parts of the scene divided by the homogeneous coordinate.
    // Not `mix`, which loses the 1 beside a large coordinate where a device has it as a + (b - a) t.
    let w = fma(1.0 - along, ray.end_w, along);
    let part = ray.reach * along / max(w, 1e-30);
    return saturate((1.0 - part) / CONTACT_SHADOW_FADE);
}
