import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import node::map_encoding::{PLANE, encoding_channels, encoding_texel};
import node::map_filtering::{filtering_texel, filtering_value};
import node::map_texel::{filtered_texels};
import node::specialization::{PLANES, RECEIVER_BIAS, SPLIT_SUMS_FROM, STORAGE};
import moment_shadows::maths::split_sum::{split_sum_coarse};
import moment_shadows::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_PACKED32, STORAGE_PACKED64, STORAGE_UNORM10, STORAGE_UNORM16, storage_pack, storage_unpack};
import moment_shadows::moments::coarse_four_moments::{coarse_four_moments_pack, coarse_four_moments_unpack};
import moment_shadows::moments::packed_four_moments::{packed_four_moments_channels, packed_four_moments_from_channels};
import node::technique::{technique_shadow_intensity};
import node::technique_receiver::{TechniqueReceiver};

// One input of the stability report: a map's texel is made of surfaces, every stage rounded to the storage, and evaluated
// with the adapters that the nodes link.

const KIND_MIXTURE: u32 = 0u;
const KIND_PATCH: u32 = 1u;

// The layout of `Input` on the host side, which says what the fields are.
struct BatchInput {
    depths: array<vec4f, 2>,
    weights: array<vec4f, 2>,
    conversion: DepthConversion,
    fragment_depth: f32,
    kind: u32,
    converted: u32,
    count: u32,
    kernel: u32,
    coverage: u32,
    rows: array<u32, 2>,
    column: u32,
    row_run: u32,
    column_run: u32,
    padding: u32,
}

alias BatchOutput = f32;

// The texel that a texture would hold.
fn stored(texel: vec4f) -> vec4f {
    switch STORAGE {
        case STORAGE_UNORM16: {
            return vec4f(unpack2x16unorm(pack2x16unorm(texel.xy)), unpack2x16unorm(pack2x16unorm(texel.zw)));
        }
        case STORAGE_FLOAT16: {
            return vec4f(unpack2x16float(pack2x16float(texel.xy)), unpack2x16float(pack2x16float(texel.zw)));
        }
        case STORAGE_FLOAT32: {
            return texel;
        }
        case STORAGE_UNORM10: {
            // The fourth channel is 1, for which its two bits suffice.
            return vec4f(min(vec4u(saturate(texel) * 1023.0 + 0.5), vec4u(1023u))) / 1023.0;
        }
        case STORAGE_PACKED64: {
            return storage_unpack(storage_pack(texel));
        }
        case STORAGE_PACKED32: {
            return coarse_four_moments_unpack(coarse_four_moments_pack(texel));
        }
        default: {
            return unpack4x8unorm(pack4x8unorm(texel));
        }
    }
}

// The texel of a map that is filtered again: that of a storage that is written once has another one.
fn stored_before(texel: vec4f) -> vec4f {
    if STORAGE == STORAGE_PACKED32 {
        return packed_four_moments_from_channels(storage_unpack(storage_pack(packed_four_moments_channels(texel))));
    }
    return stored(texel);
}

// PCG hash (Jarzynski & Olano, JCGT 9(3) 2020) of a place in a pattern.
fn pattern(seed: u32, place: u32) -> u32 {
    let state = (seed + place * 0x9e3779b9u) * 747796405u + 2891336453u;
    let word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// A filter of all surfaces at once.
fn mixture_texel(depths: array<f32, 8>, weights: array<vec4f, 2>) -> vec4f {
    var z = depths;
    var w = weights;
    var sum = vec4f(0.0);
    for (var index = 0u; index < 8u; index++) {
        sum = fma(vec4f(w[index / 4u][index % 4u]), encoding_channels(z[index]), sum);
    }
    return stored(encoding_texel(sum));
}

// What the node sums up: texels, or their coarse parts and the rest apart.
struct PatchSum {
    texels: vec4f,
    rest: vec4f,
}

fn added(sum: PatchSum, weight: f32, value: vec4f, taps: u32) -> PatchSum {
    var texel = value;
    var rest = vec4f(0.0);
    if taps >= SPLIT_SUMS_FROM {
        texel = split_sum_coarse(value);
        rest = value - texel;
    }
    return PatchSum(fma(vec4f(weight), texel, sum.texels), fma(vec4f(weight), rest, sum.rest));
}

fn filtered(sum: PatchSum) -> vec4f {
    return filtering_texel(sum.texels + sum.rest);
}

// A resolve of four samples and a blur in two passes, which sums its taps in order as the node does.
fn patch_texel(depths: array<f32, 8>, input: BatchInput) -> vec4f {
    var z = depths;
    // What filters average of the resolved texels.
    var values: array<vec4f, 8>;
    for (var index = 0u; index < input.count; index++) {
        let share = f32(input.coverage);
        let sum = (4.0 - share) * encoding_channels(z[index]) + share * encoding_channels(z[(index + 1u) % input.count]);
        values[index] = filtering_value(stored_before(encoding_texel(sum / 4.0)));
    }
    // The table holds where the weights of each kernel begin and how many there are, then the weights.
    let first = u32(batch_table[2u * input.kernel]);
    let taps = u32(batch_table[2u * input.kernel + 1u]);
    var rows = input.rows;
    var sums: array<PatchSum, 2>;
    for (var tap = 0u; tap < taps; tap++) {
        let weight = batch_table[first + tap];
        let place = tap / input.row_run;
        sums[0] = added(sums[0], weight, values[pattern(rows[0], place) % input.count], taps);
        sums[1] = added(sums[1], weight, values[pattern(rows[1], place) % input.count], taps);
    }
    let one = filtering_value(stored_before(filtered(sums[0])));
    let other = filtering_value(stored_before(filtered(sums[1])));
    var sum: PatchSum;
    for (var tap = 0u; tap < taps; tap++) {
        let is_other = (pattern(input.column, tap / input.column_run) & 1u) == 1u;
        sum = added(sum, batch_table[first + tap], select(one, other, is_other), taps);
    }
    return stored(filtered(sum));
}

fn moment_depth(depth: f32, input: BatchInput) -> f32 {
    if input.converted == 1u {
        return depth_to_moment_depth(depth, input.conversion);
    }
    return depth;
}

fn batch(input: BatchInput) -> BatchOutput {
    var given = input.depths;
    var depths: array<f32, 8>;
    for (var index = 0u; index < 8u; index++) {
        depths[index] = moment_depth(given[index / 4u][index % 4u], input);
    }
    for (var plane = 0u; plane < PLANES; plane++) {
        PLANE = plane;
        if input.kind == KIND_MIXTURE {
            filtered_texels[plane] = mixture_texel(depths, input.weights);
        } else if input.kind == KIND_PATCH {
            filtered_texels[plane] = patch_texel(depths, input);
        } else {
            filtered_texels[plane] = stored(input.weights[0]);
        }
        // Lookups average moments where texels are packed.
        if STORAGE == STORAGE_PACKED64 {
            filtered_texels[plane] = filtering_value(filtered_texels[plane]);
        }
    }
    var receiver: TechniqueReceiver;
    receiver.fragment_depth = moment_depth(input.fragment_depth, input) - RECEIVER_BIAS;
    return technique_shadow_intensity(receiver);
}
