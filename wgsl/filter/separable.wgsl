import super::super::maths::split_sum::{split_sum_coarse};

// One direction of a separable filter, for one output or for several in a row.
//
// Who makes several outputs loads every texel once and adds it to the sums of all of them: no workgroup memory is needed. The sums
// are members of structs because shader compilers do not reliably keep an array of sums in registers. Texels come in order,
// from the first that output 0 needs to the last that the last output needs; the caller loads them, and repeats the last
// texel of a region beyond its edge. The weights of a texel slide along the kernel: with a zero before the kernel's weights and
// behind them for each output but one, the texel number t takes as many as there are outputs, from number t on, and the first of
// these belongs to the last output. Weights sum to one (the host-side `Kernel`).
//
// `is_split` says whether sums are kept in two parts (the module `split_sum`), which float32 needs, and packed texels of wide kernels. It and `skips_zeros`
// are meant to be constants: what they rule out then costs nothing.

// `sum` with one more texel. With `skips_zeros`, a weight of zero adds nothing whatever the texel is; that costs a comparison,
// or nothing where weights are constants, and then their zeros cost nothing either.
fn separable_add(sum: vec4f, weight: f32, texel: vec4f, skips_zeros: bool) -> vec4f {
    return select(fma(vec4f(weight), texel, sum), sum, skips_zeros && weight == 0.0);
}

// One sum for each of eight outputs.
struct SeparableSums {
    s0: vec4f,
    s1: vec4f,
    s2: vec4f,
    s3: vec4f,
    s4: vec4f,
    s5: vec4f,
    s6: vec4f,
    s7: vec4f,
}

// `sums` with one more texel and its eight weights, that of output 7 first.
fn separable_add_to_sums(sums: SeparableSums, texel: vec4f, w0: vec4f, w1: vec4f, skips_zeros: bool) -> SeparableSums {
    return SeparableSums(
        separable_add(sums.s0, w1.w, texel, skips_zeros),
        separable_add(sums.s1, w1.z, texel, skips_zeros),
        separable_add(sums.s2, w1.y, texel, skips_zeros),
        separable_add(sums.s3, w1.x, texel, skips_zeros),
        separable_add(sums.s4, w0.w, texel, skips_zeros),
        separable_add(sums.s5, w0.z, texel, skips_zeros),
        separable_add(sums.s6, w0.y, texel, skips_zeros),
        separable_add(sums.s7, w0.x, texel, skips_zeros),
    );
}

// The sums of eight outputs, which begin as zeros. Sums that are not split have no coarse part.
struct SeparableEight {
    coarse: SeparableSums,
    rest: SeparableSums,
}

// Eight outputs with one more texel and its weights, that of output 7 first.
fn separable_add_to_eight(eight: SeparableEight, texel: vec4f, w0: vec4f, w1: vec4f, is_split: bool, skips_zeros: bool) -> SeparableEight {
    var coarse = eight.coarse;
    var rest = texel;
    if is_split {
        let part = split_sum_coarse(texel);
        coarse = separable_add_to_sums(coarse, part, w0, w1, skips_zeros);
        rest -= part;
    }
    return SeparableEight(coarse, separable_add_to_sums(eight.rest, rest, w0, w1, skips_zeros));
}

// The eight outputs.
fn separable_outputs(eight: SeparableEight) -> SeparableSums {
    return SeparableSums(
        eight.coarse.s0 + eight.rest.s0,
        eight.coarse.s1 + eight.rest.s1,
        eight.coarse.s2 + eight.rest.s2,
        eight.coarse.s3 + eight.rest.s3,
        eight.coarse.s4 + eight.rest.s4,
        eight.coarse.s5 + eight.rest.s5,
        eight.coarse.s6 + eight.rest.s6,
        eight.coarse.s7 + eight.rest.s7,
    );
}

// The sums of sixteen outputs, which begin as zeros.
struct SeparableSixteen {
    // Outputs 0 to 7.
    first: SeparableEight,
    // Outputs 8 to 15.
    second: SeparableEight,
}

// Sixteen outputs with one more texel and its weights, that of output 15 first.
fn separable_add_to_sixteen(sixteen: SeparableSixteen, texel: vec4f, w0: vec4f, w1: vec4f, w2: vec4f, w3: vec4f, is_split: bool) -> SeparableSixteen {
    return SeparableSixteen(
        separable_add_to_eight(sixteen.first, texel, w2, w3, is_split, false),
        separable_add_to_eight(sixteen.second, texel, w0, w1, is_split, false),
    );
}
