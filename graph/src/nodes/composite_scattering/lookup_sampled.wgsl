import node::moments_lookup::{moments_map, moments_sampler};

// The lookup in the integrated map where the device can filter it: the map is one region, at whose edges samplers clamp.

fn scattering_lookup(plane: u32, uv: vec2f) -> vec4f {
    return textureSampleLevel(moments_map, moments_sampler, uv, plane, 0.0);
}
