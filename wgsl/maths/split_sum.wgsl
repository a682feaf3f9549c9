// Sums of many weighted texels in f32 whose error is little more than that of the last rounding.
//
// A sum of n products in f32 is off by up to n / 3 units of 2^-24, all on one side where equal weights meet equal depths:
// more than the moment bias of float32 covers if a filter is wide. Therefore each value within [-1, 1] is split into a coarse
// part, a multiple of 1 / 64, and the rest, and the two are summed separately. Weights are multiples of 2^-18 that sum to one
// (the host-side `Kernel`), so every partial sum of coarse parts is a multiple of 2^-24 within [-1, 1] and exact in f32, in
// any order and with or without fma. The error of the rest is 2^-7 of the error that the whole would have.

// The coarse part. Values farther out become finite multiples of 1 / 64, too; their sums are only as exact as f32.
fn split_sum_coarse(value: vec4f) -> vec4f {
    return round(value * 64.0) * (1.0 / 64.0);
}
