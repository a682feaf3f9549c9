import node::fullscreen::{Interpolated};
import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::shade::leak_reduction::{leak_reduction_full_shadow};
import moment_shadows::map::storage::{STORAGE_UNORM16};

// Hamburger four-moment shadow mapping as a forward shader evaluates it: one fetch, dequantisation, moment bias, bound and
// leak reduction, with nothing around it.

@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var map_sampler: sampler;

@fragment
fn shade(input: Interpolated) -> @location(0) vec4f {
    let texel = textureSample(map, map_sampler, input.place.xy);
    let intensity = hamburger4_shadow_intensity_of_texel(texel, input.place.z, STORAGE_UNORM16);
    return vec4f(leak_reduction_full_shadow(intensity, 0.98), 0.0, 0.0, 1.0);
}
