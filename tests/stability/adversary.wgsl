import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::moments::four_moments::{FOUR_MOMENTS_BIAS_FLOAT32, four_moments_apply_bias, four_moments_bias_of, four_moments_clamp, four_moments_from_depth, four_moments_from_texel, four_moments_to_texel};
import moment_shadows::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_UNORM16};
import moment_shadows::bounds::hamburger4::{hamburger4_bounds, hamburger4_shadow_intensity, hamburger4_shadow_intensity_of_texel};

// Random and hostile inputs, made on the device: one invocation tries `count` of them and keeps the first that fails.
struct BatchInput {
    seed: u32,
    count: u32,
}

struct BatchOutput {
    // Results that are NaN or outside [0, 1].
    faults: u32,
    // Faults counted among two planted results per invocation, one NaN and one just above 1: 2 if faults are seen at all.
    control: u32,
    // The first failing input: its kind, which of the results failed, its bits.
    first_class: u32,
    first_result: u32,
    first_value: u32,
    first_depth: u32,
    padding: vec2u,
    first_moments: vec4u,
}

const CLASSES: u32 = 8u;

var<private> random_state: u32;

// PCG hash (Jarzynski & Olano, JCGT 9(3) 2020).
fn random_bits() -> u32 {
    random_state = random_state * 747796405u + 2891336453u;
    let word = ((random_state >> ((random_state >> 28u) + 4u)) ^ random_state) * 277803737u;
    return (word >> 22u) ^ word;
}

// In [0, 1).
fn random_unit() -> f32 {
    return f32(random_bits() >> 8u) * 0x1p-24;
}

// In [-1, 1).
fn random_signed() -> f32 {
    return 2.0 * random_unit() - 1.0;
}

// Any finite number by its bits: subnormals, zeros of both signs and the largest numbers are as likely as any exponent.
fn random_finite() -> f32 {
    let bits = random_bits();
    let exponent = (bits >> 8u) % 255u;
    return bitcast<f32>((bits & 0x80000000u) | (exponent << 23u) | (random_bits() >> 9u));
}

// Between 1e15 and 3e38, of either sign.
fn random_huge() -> f32 {
    let bits = random_bits();
    let exponent = 177u + (bits >> 8u) % 77u;
    return bitcast<f32>((bits & 0x80000000u) | (exponent << 23u) | (random_bits() >> 9u));
}

// Non-finite numbers: infinities and NaN of every payload.
fn random_not_finite() -> f32 {
    let payload = select(random_bits() >> 9u, 0u, random_unit() < 0.3);
    return bitcast<f32>((random_bits() & 0x80000000u) | 0x7f800000u | payload);
}

// A sub-unit step of a few ulp.
fn nudge(value: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(value) + random_bits() % 9u - 4u);
}

// Whether a result is NaN or outside [0, 1], by its bits alone; -0 is 0.
fn is_fault(value: f32) -> bool {
    let bits = bitcast<u32>(value);
    return bits > 0x3f800000u && bits != 0x80000000u;
}

fn random_moments(kind: u32) -> vec4f {
    switch kind {
        case 0u: {
            // Mostly impossible.
            return vec4f(random_signed(), random_signed(), random_signed(), random_signed());
        }
        case 1u: {
            return vec4f(random_finite(), random_finite(), random_finite(), random_finite());
        }
        case 2u: {
            // Two surfaces, the share of the second down to 2^-24.
            let near = four_moments_from_depth(random_signed());
            let far = four_moments_from_depth(random_signed());
            return mix(near, far, exp2(-24.0 * random_unit()));
        }
        case 3u: {
            // One surface within a few roundings: the boundary of what is possible, from both sides.
            let b = four_moments_from_depth(random_signed());
            return vec4f(nudge(b.x), nudge(b.y), nudge(b.z), nudge(b.w));
        }
        case 4u: {
            return vec4f(random_huge(), random_huge(), random_huge(), random_huge());
        }
        case 5u: {
            // Any texel of unorm storage, whatever it encodes.
            return vec4f(random_unit(), random_unit(), random_unit(), random_unit());
        }
        case 6u: {
            // Ends and zeros.
            let bits = vec4f(vec4u(random_bits() % 3u, random_bits() % 2u, random_bits() % 3u, random_bits() % 2u));
            return bits - vec4f(1.0, 0.0, 1.0, 0.0);
        }
        default: {
            // Any texel of float16 storage with the optimised basis.
            return vec4f(random_unit(), random_unit(), random_unit(), random_unit()) - 0.5;
        }
    }
}

fn random_depth(moments: vec4f) -> f32 {
    switch random_bits() % 5u {
        case 0u: {
            return random_signed();
        }
        case 1u: {
            return random_finite();
        }
        case 2u: {
            return random_huge();
        }
        case 3u: {
            // At the mean, or at what a single surface would be.
            return clamp(nudge(moments.x), -3e38, 3e38);
        }
        default: {
            return select(-1.0, 1.0, random_unit() < 0.5) * select(1.0, 0.0, random_unit() < 0.3);
        }
    }
}

fn batch(input: BatchInput) -> BatchOutput {
    random_state = input.seed;
    var output = BatchOutput();
    for (var index = 0u; index < input.count; index++) {
        let kind = index % CLASSES;
        let texel = random_moments(kind);
        let depth = random_depth(texel);
        var results: array<f32, 15>;
        for (var stored_as = 0u; stored_as < 3u; stored_as++) {
            let bias = four_moments_bias_of(stored_as);
            // Moments as the solver may get them: out of any storage, or given by a host.
            let decoded = four_moments_from_texel(texel, stored_as);
            results[stored_as] = hamburger4_shadow_intensity(decoded, depth, bias);
            let biased = four_moments_apply_bias(four_moments_clamp(texel), bias);
            let bounds = hamburger4_bounds(biased, depth, bias.alpha);
            results[3u + 2u * stored_as] = bounds.x;
            results[4u + 2u * stored_as] = bounds.y;
        }
        // Texels as textures can hold them: unorm channels are in [0, 1].
        results[12] = hamburger4_shadow_intensity_of_texel(saturate(texel), depth, STORAGE_UNORM16);
        results[13] = hamburger4_shadow_intensity_of_texel(texel, depth, STORAGE_FLOAT16);
        results[14] = hamburger4_shadow_intensity_of_texel(texel, depth, STORAGE_FLOAT32);
        // Moments that no bias has pulled back.
        results[9] = hamburger4_bounds(four_moments_clamp(texel), depth, FOUR_MOMENTS_BIAS_FLOAT32.alpha).x;
        // Depth of any bits on its way into a map.
        var stored = random_unit();
        if kind < 2u {
            stored = random_not_finite();
        } else if kind < 4u {
            stored = random_finite();
        }
        let conversion = DepthConversion(vec2f(-1.0, 1.0), vec2f(1.0), 1.0, 0.0, vec2f(0.0));
        let moment_depth = depth_to_moment_depth(stored, conversion);
        results[10] = 0.5 * (moment_depth + 1.0);
        let channels = four_moments_to_texel(four_moments_from_depth(moment_depth), random_bits() % 2u);
        results[11] = select(channels.x, abs(channels.x) * 2.0, channels.x < 0.0);
        for (var result = 0u; result < 15u; result++) {
            if is_fault(results[result]) {
                if output.faults == 0u {
                    output.first_class = kind;
                    output.first_result = result;
                    output.first_value = bitcast<u32>(results[result]);
                    output.first_depth = bitcast<u32>(depth);
                    output.first_moments = bitcast<vec4u>(texel);
                }
                output.faults++;
            }
        }
    }
    // The counter itself has to see what it is there for.
    output.control = u32(is_fault(random_not_finite())) + u32(is_fault(bitcast<f32>(0x3f800001u + (random_bits() & 1u))));
    return output;
}
