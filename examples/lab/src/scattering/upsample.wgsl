import node::scattering_view::{view_surface};

// Bilateral upsampling of radiance at half of the resolution: the four nearest texels, by place and by how far away what they
// saw is (Kopf et al., "Joint bilateral upsampling", SIGGRAPH 2007).

@group(0) @binding(2) var half_radiance: texture_2d<f32>;

// Beyond this part of the distance a texel saw something else.
const SIMILAR = 0.03;

@fragment
fn upsample(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(position.xy);
    let size = vec2i(textureDimensions(half_radiance));
    let distance = length(view_surface(pixel));
    let first = pixel / 2;
    let odd = vec2f(pixel % 2) * 0.5;
    var sum = vec4f(0.0);
    var weights = 0.0;
    for (var index = 0; index < 4; index++) {
        let step = vec2i(index & 1, index >> 1u);
        let texel = min(first + step, size - 1);
        let near = select(1.0 - odd, odd, step == vec2i(1));
        let difference = abs(length(view_surface(2 * texel)) - distance) / (SIMILAR * max(distance, 1e-30));
        let weight = near.x * near.y * (exp(-difference * difference) + 1e-4);
        sum = fma(vec4f(weight), textureLoad(half_radiance, texel, 0), sum);
        weights += weight;
    }
    return sum / max(weights, 1e-9);
}
