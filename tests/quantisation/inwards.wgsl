import moment_shadows::moments::inward_rounding::{inward_rounding_texel};

struct BatchInput {
    moments: vec4f,
    stored_as: u32,
    padding_x: u32,
    padding_y: u32,
    padding_z: u32,
}

struct BatchOutput {
    texel: vec4f,
}

fn batch(input: BatchInput) -> BatchOutput {
    return BatchOutput(inward_rounding_texel(input.moments, input.stored_as));
}
