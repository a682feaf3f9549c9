import moment_shadows::bounds::hamburger6::{hamburger6_shadow_intensity};
import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::map::map_load::{map_load_bilinear};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::opaque_depth::{opaque_depth_farthest};
import moment_shadows::map::translucent_casters::{translucent_casters_six_moments, translucent_casters_six_moments_bias};
import moment_shadows::moments::six_moments::{six_moments_bias_of, six_moments_from_texels};
import node::map::{BLENDS, STORAGE};

// Glass and smoke: quads that are blended into the light's map, and into the picture.

struct Frame {
    // Of the light in the first pass, of the camera in the second.
    clip_from_world: mat4x4f,
    light_clip_from_world: mat4x4f,
    conversion: DepthConversion,
}

struct Quad {
    centre: vec3f,
    opacity: f32,
    right: vec3f,
    // Whether it fades out from its middle on.
    soft: f32,
    up: vec3f,
    brightness: f32,
}

@group(0) @binding(0) var<uniform> frame: Frame;
@group(0) @binding(1) var<storage, read> quads: array<Quad>;
@group(0) @binding(2) var light_depth: texture_depth_multisampled_2d;
@group(0) @binding(3) var shadow_map: texture_2d_array<f32>;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) corner: vec2f,
    @location(2) @interpolate(flat) quad: u32,
}

@vertex
fn quad(@builtin(vertex_index) index: u32, @builtin(instance_index) instance: u32) -> Vertex {
    let corners = array(vec2f(-1.0, -1.0), vec2f(1.0, -1.0), vec2f(-1.0, 1.0), vec2f(1.0, 1.0));
    let corner = corners[index];
    let it = quads[instance];
    let world = it.centre + corner.x * it.right + corner.y * it.up;
    return Vertex(frame.clip_from_world * vec4f(world, 1.0), world, corner, instance);
}

fn opacity(vertex: Vertex) -> f32 {
    let it = quads[vertex.quad];
    let inside = saturate(1.0 - dot(vertex.corner, vertex.corner));
    return it.opacity * mix(1.0, inside * inside, it.soft);
}

struct Planes {
    @location(0) odd: vec4f,
    @location(1) even: vec4f,
}

// Into the light's map. The light's depth has four samples per texel and cannot be tested by a pass beside the map, so it is here.
@fragment
fn caster(vertex: Vertex) -> Planes {
    let depth = depth_to_moment_depth(vertex.clip.z, frame.conversion);
    if depth >= opaque_depth_farthest(light_depth, vec2i(vertex.clip.xy), frame.conversion) {
        discard;
    }
    let texels = translucent_casters_six_moments(depth, opacity(vertex), STORAGE);
    return Planes(texels[0], texels[1]);
}

// Into the picture, in the shadow of what the map has in front: of other quads, too.
@fragment
fn seen(vertex: Vertex) -> @location(0) vec4f {
    let clip = frame.light_clip_from_world * vec4f(vertex.world, 1.0);
    let place = vec2f(0.5, -0.5) * clip.xy + 0.5;
    let whole = MapRegion(vec2u(0u), textureDimensions(shadow_map));
    let texels = array<vec4f, 2>(
        map_load_bilinear(shadow_map, 0u, whole, place, 0u),
        map_load_bilinear(shadow_map, 1u, whole, place, 0u),
    );
    let bias = translucent_casters_six_moments_bias(six_moments_bias_of(STORAGE), BLENDS);
    let depth = depth_to_moment_depth(clip.z, frame.conversion);
    let light = 1.0 - hamburger6_shadow_intensity(six_moments_from_texels(texels, STORAGE), depth, bias);
    return vec4f(vec3f(quads[vertex.quad].brightness * (0.15 + 0.85 * light)), opacity(vertex));
}
