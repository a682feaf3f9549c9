// The vertex stage of the reference shaders: one triangle, with a place in the map and a fragment depth to interpolate.

struct Interpolated {
    @builtin(position) position: vec4f,
    // x and y in the map from 0 to 1, z in moment depth.
    @location(0) place: vec3f,
}

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> Interpolated {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return Interpolated(vec4f(4.0 * corner - 1.0, 0.0, 1.0), vec3f(2.0 * corner, corner.x));
}
