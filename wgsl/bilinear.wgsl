// Bilinear filtering in the shader, for storage that a device cannot filter.
//
// Blending texels of moments is a convex combination, so it keeps moments valid; it is done in f32, while hardware may
// use weights of as few as 8 bits.

// The bilinearly filtered texel of mip 0 of `layer` at `uv`: texel centres at half-integer places, clamped to the edge.
// `uv` is finite; values outside [0, 1] count as the nearer edge.
fn bilinear_load(map: texture_2d_array<f32>, uv: vec2f, layer: u32) -> vec4f {
    let size = vec2f(textureDimensions(map));
    let place = clamp(uv, vec2f(0.0), vec2f(1.0)) * size - 0.5;
    let base = floor(place);
    let weight = place - base;
    let last = vec2i(textureDimensions(map)) - 1;
    let low = clamp(vec2i(base), vec2i(0), last);
    let high = clamp(vec2i(base) + 1, vec2i(0), last);
    let top = mix(textureLoad(map, low, layer, 0), textureLoad(map, vec2i(high.x, low.y), layer, 0), weight.x);
    let bottom = mix(textureLoad(map, vec2i(low.x, high.y), layer, 0), textureLoad(map, high, layer, 0), weight.x);
    return mix(top, bottom, weight.y);
}
