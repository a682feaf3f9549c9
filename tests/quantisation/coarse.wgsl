import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::map::storage::{STORAGE_PACKED32};
import moment_shadows::moments::coarse_four_moments::{coarse_four_moments_bilinear, coarse_four_moments_pack, coarse_four_moments_unpack};

// Four texels of 32 bits, and what a lookup between them gives; beside it what the moments themselves give.

struct BatchInput {
    // Moments to store in each texel.
    moments: array<vec4f, 4>,
    // Integers to read instead, where `as_given` is not 0.
    texels: vec4u,
    // From the first texel: the second lies along x, the third along y.
    place: vec2f,
    fragment_depth: f32,
    // A storage to evaluate the mean of the moments with, which holds them as they are.
    compared: u32,
    as_given: u32,
    padding_0: u32,
    padding_1: u32,
    padding_2: u32,
}

struct BatchOutput {
    // The moments that the first texel gives.
    first: vec4f,
    // The mean of all, one by one.
    average: vec4f,
    // The same from a gather of all.
    mean: vec4f,
    intensity: f32,
    compared: f32,
    // The first texel.
    texel: u32,
    padding: u32,
}

fn batch(input: BatchInput) -> BatchOutput {
    var moments = input.moments;
    var texels = input.texels;
    let place = input.place;
    let weights = vec4f(1.0 - place.x, place.x, 1.0 - place.x, place.x) * vec4f(vec2f(1.0 - place.y), vec2f(place.y));
    var output: BatchOutput;
    var exact = vec4f(0.0);
    for (var index = 0u; index < 4u; index++) {
        if input.as_given == 0u {
            texels[index] = coarse_four_moments_pack(moments[index]);
        }
        output.average = fma(vec4f(weights[index]), coarse_four_moments_unpack(texels[index]), output.average);
        exact = fma(vec4f(weights[index]), moments[index], exact);
    }
    output.texel = texels.x;
    output.first = coarse_four_moments_unpack(texels.x);
    // The order of a gather.
    output.mean = coarse_four_moments_bilinear(texels.zwyx, place);
    output.intensity = hamburger4_shadow_intensity_of_texel(output.mean, input.fragment_depth, STORAGE_PACKED32);
    output.compared = hamburger4_shadow_intensity_of_texel(exact, input.fragment_depth, input.compared);
    return output;
}
