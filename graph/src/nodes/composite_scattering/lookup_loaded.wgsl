import moment_shadows::map::map_region::{MapRegion};
import node::moments_lookup::{moments_lookup, moments_map};

// The lookup in the integrated map where the device cannot filter it.

fn scattering_lookup(plane: u32, uv: vec2f) -> vec4f {
    let region = MapRegion(vec2u(0u), textureDimensions(moments_map));
    return moments_lookup(plane, region, uv, vec2f(0.0), vec2f(0.0));
}
