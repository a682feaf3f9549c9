import moment_shadows::summed_area_table_encoding::{summed_area_table_from_unorm16};

// Maps of unorm16: their own integers.

fn source_integers(texel: vec4f) -> vec4u {
    return summed_area_table_from_unorm16(texel);
}
