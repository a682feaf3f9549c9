import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};
import moment_shadows::map::storage::{storage_pack, storage_unpack};
import moment_shadows::moments::four_moments::{four_moments_bias_of, four_moments_filter_texel, four_moments_filter_value};
import moment_shadows::moments::packed_four_moments::{packed_four_moments_bilinear};

// Four texels of a packed storage as textures hold them, and what a lookup between them gives.

struct BatchInput {
    // Moments to store in each texel.
    moments: array<vec4f, 4>,
    // From the first texel: the second lies along x, the third along y.
    place: vec2f,
    unused: vec2f,
    // Integers to read instead, where `as_given` is not 0.
    texels: array<vec4u, 4>,
    fragment_depth: f32,
    stored_as: u32,
    as_given: u32,
    padding: u32,
}

struct BatchOutput {
    // The moments that the first texel gives.
    first: vec4f,
    // The average of all, one by one.
    average: vec4f,
    // The same from a gather of all, whose order is another.
    mean: vec4f,
    intensity: f32,
    // Whether the first texel is the same when it is unpacked and packed again.
    is_kept: u32,
    padding: vec2u,
}

// The components of a gather in which the texels are.
const GATHERED = array<u32, 4>(3u, 2u, 0u, 1u);

fn batch(input: BatchInput) -> BatchOutput {
    var moments = input.moments;
    var texels = input.texels;
    let place = input.place;
    let weights = vec4f(1.0 - place.x, place.x, 1.0 - place.x, place.x) * vec4f(vec2f(1.0 - place.y), vec2f(place.y));
    var output: BatchOutput;
    var words = array<vec4u, 2>();
    for (var index = 0u; index < 4u; index++) {
        var stored = texels[index];
        if input.as_given == 0u {
            stored = storage_pack(four_moments_filter_texel(moments[index], input.stored_as));
        }
        let channels = storage_unpack(stored);
        let value = four_moments_filter_value(channels, input.stored_as);
        if index == 0u {
            output.first = value;
            output.is_kept = u32(all(storage_pack(channels) == stored));
        }
        output.average = fma(vec4f(weights[index]), value, output.average);
        words[0][GATHERED[index]] = stored.x;
        words[1][GATHERED[index]] = stored.y;
    }
    output.mean = packed_four_moments_bilinear(words[0], words[1], input.place);
    output.intensity = hamburger4_shadow_intensity(output.mean, input.fragment_depth, four_moments_bias_of(input.stored_as));
    return output;
}
