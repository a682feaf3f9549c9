// The two occluders of a texel.
struct Occluders {
    // Rectified depths.
    depths: vec2f,
    // For each of them: what of it counts as an occluder in front of all view rays, and what as one at its depth. The rest, up to 1,
    // counts as none.
    shares: array<vec2f, 2>,
}
