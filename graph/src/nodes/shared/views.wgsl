import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::shade::area_light::{AreaLight};
import moment_shadows::shade::leak_reduction::{LeakReduction};
import moment_shadows::shade::receiver_bias::{ReceiverBias};
import node::specialization::{GROUP, VIEWS};

// The views of lights, and where a pixel's surface lies in them.

struct ViewParameters {
    // From the camera's clip space (x, y, stored depth, 1) to the light: x and y are the place in the map in [0, 1], z its
    // homogeneous coordinate (positive in front of the light) and w the moment depth, all times the factors they are
    // divided by. Camera and light are combined in one matrix so that no large scene coordinates occur.
    light_from_camera: mat4x4f,
    // The homogeneous coordinate of the scene position, which divides the moment depth.
    scene_w_from_camera: vec4f,
    // By rows, the scene position relative to the camera, times that coordinate: for normals.
    position_from_camera: mat3x4f,
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // The view's place in its layer; a view without texels is unused.
    region: MapRegion,
    // The stored depth of pixels that show no surface; the same for all views.
    far_depth: f32,
    // The map's layer.
    layer: u32,
    // The light's channel, 0 to 15, four in each target, of which the first view that contains a pixel shades it. With BORDERS also
    // VIEW_FADES, VIEW_ROUND, and in the upper half, in sixteenths of a texel, the width of the view's border: there it gives way to
    // the other views that contain the pixel, or, where it fades, to light.
    channel: u32,
    // Texels along the region's edges that filters read, but in which no place is looked up.
    guard: f32,
    // How the light's map stores depth, and how large the light is: for tests on the plain depth map.
    conversion: DepthConversion,
    light: AreaLight,
}

// Beside a view's channel: its shadows fade out along its border, or its border is the circle within the region, a spot's cone.
const VIEW_FADES: u32 = 16u;
const VIEW_ROUND: u32 = 32u;

@group(GROUP) @binding(0) var<uniform> views: array<ViewParameters, VIEWS>;

// A pixel's surface as the light sees it.
struct Receiver {
    // x and y in the map from 0 to 1, z in moment depth.
    place: vec3f,
    // What x and y were divided by; positive in front of the light.
    light_w: f32,
    // One over it, and over what z was divided by; positive in front of the camera.
    per_light_w: f32,
    per_scene_w: f32,
}

// The surface at a place in the camera's clip space.
fn receiver_at(view: u32, clip: vec4f) -> Receiver {
    let light = views[view].light_from_camera * clip;
    // Results behind the camera or the light are not used.
    let per_light_w = 1.0 / max(light.z, 1e-30);
    let per_scene_w = 1.0 / max(dot(views[view].scene_w_from_camera, clip), 1e-30);
    return Receiver(vec3f(light.xy * per_light_w, light.w * per_scene_w), light.z, per_light_w, per_scene_w);
}
