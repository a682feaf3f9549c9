// An error: a vector has no place in a scalar.

fn mean(moments: vec4f) -> f32 {
    return moments.xy;
}
