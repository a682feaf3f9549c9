// Texels as textures hold them are their channels.

fn texel_of_texture(stored: vec4f) -> vec4f {
    return stored;
}

fn texel_to_texture(texel: vec4f) -> vec4f {
    return texel;
}
