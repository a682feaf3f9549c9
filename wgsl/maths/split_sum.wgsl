// Sums of many weighted texels in f32 that are off by little more than their last rounding.
//
// A sum of n products in f32 is off by up to n / 3 units of 2^-24, all on one side where equal weights meet equal depths:
// more than the moment bias of float32 covers if a filter is wide. So each value within [-1, 1] is split into a coarse part,
// a multiple of 1 / 64, and the rest, and both are summed apart. Weights are multiples of 2^-18 that sum to one (the
// host-side `Kernel`), so that every partial sum of coarse parts is a multiple of 2^-24 within [-1, 1] and exact in f32, in
// any order and with or without fma. What the rest is off by is 2^-7 of what the whole would be.

// The coarse part. Values farther out are finite multiples of 1 / 64, too; their sums are those of f32.
fn split_sum_coarse(value: vec4f) -> vec4f {
    return round(value * 64.0) * (1.0 / 64.0);
}
