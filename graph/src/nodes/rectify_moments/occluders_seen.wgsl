import node::specialization::{GROUP};
import moment_shadows::air::view_rays::{view_rays_occluder};

// It is known which view rays pass a texel.

@group(GROUP) @binding(6) var view_rays_map: texture_2d<u32>;

fn occluders_of(place: vec2u, depths: vec2f) -> vec2f {
    let texel = textureLoad(view_rays_map, place, 0).xy;
    return vec2f(view_rays_occluder(texel, depths.x), view_rays_occluder(texel, depths.y));
}
