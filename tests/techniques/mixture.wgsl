import moment_shadows::techniques::convolution::{CONVOLUTION_DAMPING, convolution_channels, convolution_plane, convolution_receiver, convolution_shadow_intensity, convolution_to_texel};
import moment_shadows::techniques::exponential::{exponential_channels, exponential_mean_of_texel, exponential_shadow_intensity_of_texel, exponential_to_texel};
import moment_shadows::techniques::exponential_variance::{exponential_variance_channels, exponential_variance_shadow_intensity_of_texel, exponential_variance_to_texel};
import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity_of_texel};
import moment_shadows::bounds::hausdorff4::{hausdorff4_shadow_intensity_of_texel};
import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers, layered_variance_channels, layered_variance_last_layer, layered_variance_shadow_intensity_of_texel};
import moment_shadows::moments::four_moments::{four_moments_from_depth, four_moments_to_texel};
import moment_shadows::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_UNORM16};
import moment_shadows::bounds::chebyshev::{chebyshev_shadow_intensity_of_texel, chebyshev_upper_bound};
import moment_shadows::moments::two_moments::{two_moments_from_depth, two_moments_from_texel, two_moments_smallest_variance_of, two_moments_to_texel};

// A mixture of surfaces: encoded, averaged, rounded once to a storage as a texture would hold it, and evaluated by every
// technique.

struct BatchInput {
    depths: array<vec4f, 2>,
    weights: array<vec4f, 2>,
    layers: LayeredVarianceLayers,
    // Exponents of the exponential technique (plain, logarithmic) and of the exponential variance technique.
    exponents: vec4f,
    fragment_depth: f32,
    stored_as: u32,
    terms: u32,
    padding: u32,
}

struct BatchOutput {
    variance: f32,
    variance_upper: f32,
    layered: f32,
    exponential: f32,
    exponential_logarithmic: f32,
    // Filtered between texels that are rounded each.
    exponential_filtered: f32,
    exponential_variance_2: f32,
    exponential_variance_4: f32,
    convolution: f32,
    convolution_series: f32,
    hamburger: f32,
    hausdorff: f32,
}

fn stored(texel: vec4f, stored_as: u32) -> vec4f {
    switch stored_as {
        case STORAGE_UNORM16: {
            return vec4f(unpack2x16unorm(pack2x16unorm(texel.xy)), unpack2x16unorm(pack2x16unorm(texel.zw)));
        }
        case STORAGE_FLOAT16: {
            return vec4f(unpack2x16float(pack2x16float(texel.xy)), unpack2x16float(pack2x16float(texel.zw)));
        }
        case STORAGE_FLOAT32: {
            return texel;
        }
        default: {
            return unpack4x8unorm(pack4x8unorm(texel));
        }
    }
}

fn layer_intensity(input: BatchInput, layer: u32) -> f32 {
    var depths = input.depths;
    var weights = input.weights;
    let plane = layer / 2u;
    var channels = vec4f(0.0);
    for (var index = 0u; index < 8u; index++) {
        let weight = weights[index / 4u][index % 4u];
        channels += weight * layered_variance_channels(depths[index / 4u][index % 4u], input.layers, plane);
    }
    let texel = stored(two_moments_to_texel(channels, input.stored_as), input.stored_as);
    return layered_variance_shadow_intensity_of_texel(texel, input.fragment_depth, input.stored_as, input.layers, layer);
}

fn batch(input: BatchInput) -> BatchOutput {
    var depths = input.depths;
    var weights = input.weights;
    let stored_as = input.stored_as;
    let depth = input.fragment_depth;
    var variance = vec4f(0.0);
    var plain = vec4f(0.0);
    var logarithmic = vec4f(0.0);
    var filtered = vec4f(0.0);
    var exponential_variance = vec4f(0.0);
    var moments = vec4f(0.0);
    for (var index = 0u; index < 8u; index++) {
        let z = depths[index / 4u][index % 4u];
        let weight = weights[index / 4u][index % 4u];
        variance += weight * two_moments_from_depth(z);
        plain += weight * exponential_channels(z, input.exponents.x);
        let channels = exponential_channels(z, input.exponents.y);
        logarithmic += weight * channels;
        let tap = stored(exponential_to_texel(channels, stored_as, input.exponents.y, true), stored_as);
        filtered.x += weight * exponential_mean_of_texel(tap, stored_as, input.exponents.y, true);
        exponential_variance += weight * exponential_variance_channels(z, input.exponents.zw);
        moments += weight * four_moments_from_depth(z);
    }
    var output = BatchOutput();
    let variance_texel = stored(two_moments_to_texel(variance, stored_as), stored_as);
    output.variance = chebyshev_shadow_intensity_of_texel(variance_texel, depth, stored_as);
    let decoded = two_moments_from_texel(variance_texel, stored_as).xy;
    output.variance_upper = chebyshev_upper_bound(decoded, depth, two_moments_smallest_variance_of(stored_as));

    let last = layered_variance_last_layer(input.layers, depth);
    for (var layer = 0u; layer <= last; layer++) {
        output.layered = max(output.layered, layer_intensity(input, layer));
    }

    let plain_texel = stored(exponential_to_texel(plain, stored_as, input.exponents.x, false), stored_as);
    output.exponential = exponential_shadow_intensity_of_texel(plain_texel, depth, stored_as, input.exponents.x, false);
    let c = input.exponents.y;
    let logarithmic_texel = stored(exponential_to_texel(logarithmic, stored_as, c, true), stored_as);
    output.exponential_logarithmic = exponential_shadow_intensity_of_texel(logarithmic_texel, depth, stored_as, c, true);
    let filtered_texel = stored(exponential_to_texel(filtered, stored_as, c, true), stored_as);
    output.exponential_filtered = exponential_shadow_intensity_of_texel(filtered_texel, depth, stored_as, c, true);

    let warped = stored(exponential_variance_to_texel(exponential_variance, stored_as), stored_as);
    output.exponential_variance_2 =
        exponential_variance_shadow_intensity_of_texel(warped, depth, stored_as, input.exponents.zw, false);
    output.exponential_variance_4 =
        exponential_variance_shadow_intensity_of_texel(warped, depth, stored_as, input.exponents.zw, true);

    var lower = 0.0;
    var series = 0.0;
    for (var plane = 0u; plane < (input.terms + 1u) / 2u; plane++) {
        var waves = vec4f(0.0);
        for (var index = 0u; index < 8u; index++) {
            let weight = weights[index / 4u][index % 4u];
            waves += weight * convolution_channels(depths[index / 4u][index % 4u], plane, input.terms);
        }
        let texel = stored(convolution_to_texel(waves, stored_as), stored_as);
        let shifted = convolution_receiver(depth, input.terms, true);
        let receiver = convolution_receiver(depth, input.terms, false);
        lower += convolution_plane(texel, stored_as, plane, input.terms, shifted, CONVOLUTION_DAMPING);
        series += convolution_plane(texel, stored_as, plane, input.terms, receiver, CONVOLUTION_DAMPING);
    }
    output.convolution = convolution_shadow_intensity(lower, input.terms, true);
    output.convolution_series = convolution_shadow_intensity(series, input.terms, false);

    let moments_texel = stored(four_moments_to_texel(moments, stored_as), stored_as);
    output.hamburger = hamburger4_shadow_intensity_of_texel(moments_texel, depth, stored_as);
    output.hausdorff = hausdorff4_shadow_intensity_of_texel(moments_texel, depth, stored_as);
    return output;
}
