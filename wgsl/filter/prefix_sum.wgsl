// Prefix sums in registers, which summed-area tables are made of.
//
// A map is summed up in tiles (Nehab et al., SIGGRAPH Asia 2011). Who sums a tile up holds the sum of each of its columns and
// goes down row by row, adding to each column the prefix sum of the row; no workgroup memory is needed. The last columns of all
// tiles are then summed along rows, the last rows along columns. Sums are members of a struct because shader compilers do not
// reliably keep an array of sums in registers. They are integers modulo 2^32 (the module `summed_area_encoding`).

// Four values, or sums, next to each other.
struct PrefixSumFour {
    s0: vec4u,
    s1: vec4u,
    s2: vec4u,
    s3: vec4u,
}

// The prefix sums of four values, each with `before`, the sum of those before them.
fn prefix_sum_along(before: vec4u, values: PrefixSumFour) -> PrefixSumFour {
    let s0 = before + values.s0;
    let s1 = s0 + values.s1;
    let s2 = s1 + values.s2;
    return PrefixSumFour(s0, s1, s2, s2 + values.s3);
}

// Four columns with one more row.
fn prefix_sum_across(columns: PrefixSumFour, row: PrefixSumFour) -> PrefixSumFour {
    return PrefixSumFour(columns.s0 + row.s0, columns.s1 + row.s1, columns.s2 + row.s2, columns.s3 + row.s3);
}
