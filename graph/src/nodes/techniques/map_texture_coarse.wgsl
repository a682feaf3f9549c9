import moment_shadows::moments::coarse_four_moments::{coarse_four_moments_pack, coarse_four_moments_unpack};

// Textures hold four moments in one integer.

fn texel_of_texture(stored: vec4u) -> vec4f {
    return coarse_four_moments_unpack(stored.x);
}

fn texel_to_texture(texel: vec4f) -> vec4u {
    return vec4u(coarse_four_moments_pack(texel), 0u, 0u, 0u);
}
