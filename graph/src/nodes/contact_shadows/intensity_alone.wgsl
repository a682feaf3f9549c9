// Nothing is known of a pixel's shadow: it is lit.
fn intensity_at(pixel: vec2i) -> vec4f {
    return vec4f(0.0);
}
