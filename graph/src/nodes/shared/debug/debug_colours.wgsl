// Colours of debug views.

// From blue at 0 over green to red at 1.
fn debug_ramp(part: f32) -> vec3f {
    let t = 2.0 * clamp(part, 0.0, 1.0) - 1.0;
    return vec3f(max(t, 0.0), 1.0 - abs(t), max(-t, 0.0));
}

// A hue for each number, of which those that follow each other differ: the golden ratio goes round the circle.
fn debug_hue(number: u32) -> vec3f {
    let hue = fract(0.618034 * f32(number % 256u) + vec3f(0.0, 2.0 / 3.0, 1.0 / 3.0));
    return 0.15 + 0.85 * clamp(abs(6.0 * hue - 3.0) - 1.0, vec3f(0.0), vec3f(1.0));
}
