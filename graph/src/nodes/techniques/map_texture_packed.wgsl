import moment_shadows::map::storage::{storage_pack, storage_unpack};

// Textures hold the channels of texels packed into integers.

fn texel_of_texture(stored: vec4u) -> vec4f {
    return storage_unpack(stored);
}

fn texel_to_texture(texel: vec4f) -> vec4u {
    return storage_pack(texel);
}
