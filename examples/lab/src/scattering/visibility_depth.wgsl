// Visibility by the plain depth map: one load.

@group(0) @binding(2) var light_depth: texture_depth_2d;

// Whether a moment depth is in shadow at a place of the map; outside of it nothing is.
fn visibility_shadow(uv: vec2f, depth: f32) -> f32 {
    let size = vec2f(textureDimensions(light_depth));
    let inside = all(uv >= vec2f(0.0)) && all(uv <= vec2f(1.0));
    let texel = vec2i(min(saturate(uv) * size, size - 1.0));
    let stored = textureLoad(light_depth, texel, 0);
    // The lab's directional lights store depth from 0 to 1; 1 means no caster.
    return select(0.0, 1.0, inside && stored < 1.0 && fma(2.0, stored, -1.0) < depth);
}
