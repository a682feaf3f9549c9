import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_axes, minification_axes_gradients};
import node::specialization::{ANISOTROPY, GROUP};

// The lookup in a map with mip levels that the device can filter, and with one region per layer: hardware takes all probes.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var anisotropic_sampler: sampler;

// The texel at `uv` in [0, 1] across a region, filtered over a pixel with these differences of place to its neighbours.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    let gradients = minification_axes_gradients(minification_axes(difference_x, difference_y, ANISOTROPY));
    let per_texel = 1.0 / vec2f(textureDimensions(moments_map));
    let place = (vec2f(region.origin) + uv * vec2f(region.extent)) * per_texel;
    return textureSampleGrad(moments_map, anisotropic_sampler, place, layer, gradients[0] * per_texel, gradients[1] * per_texel);
}
