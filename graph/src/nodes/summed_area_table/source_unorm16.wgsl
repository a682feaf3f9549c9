import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_of_unorm16};

// Maps of unorm16: their own integers.

fn source_integers(texel: vec4f) -> vec4u {
    return summed_area_encoding_of_unorm16(texel);
}
