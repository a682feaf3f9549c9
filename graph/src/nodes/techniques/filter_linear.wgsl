import node::specialization::{STORAGE};
import moment_shadows::map::storage::{storage_round_texel};

// Texels that any filter averages.

fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}
