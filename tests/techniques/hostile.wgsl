import moment_shadows::techniques::convolution::{convolution_plane, convolution_receiver, convolution_shadow_intensity};
import moment_shadows::techniques::exponential::{exponential_shadow_intensity_of_texel};
import moment_shadows::techniques::exponential_variance::{exponential_variance_shadow_intensity_of_texel};
import moment_shadows::bounds::hausdorff4::{hausdorff4_shadow_intensity_of_texel};
import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers, layered_variance_last_layer, layered_variance_shadow_intensity_of_plane};
import moment_shadows::map::storage::{storage_is_float};
import moment_shadows::bounds::chebyshev::{chebyshev_shadow_intensity_of_texel, chebyshev_upper_bound};
import moment_shadows::moments::two_moments::{two_moments_from_texel, two_moments_smallest_variance_of};

// Any bits for texel and depth, evaluated by every technique.
struct BatchInput {
    texel: vec4u,
    splits: vec4f,
    exponents: vec2f,
    depth: u32,
    stored_as: u32,
    terms: u32,
    layers: u32,
    overlap: f32,
    damping: f32,
}

struct BatchOutput {
    intensities: array<vec4f, 3>,
}

fn batch(input: BatchInput) -> BatchOutput {
    let stored_as = input.stored_as;
    let depth = bitcast<f32>(input.depth);
    var texel = bitcast<vec4f>(input.texel);
    if !storage_is_float(stored_as) {
        // All that a unorm texture can hold.
        texel = vec4f(input.texel >> vec4u(16u)) / 65535.0;
    }
    let exponents = input.exponents;
    let layers = LayeredVarianceLayers(array<vec4f, 2>(input.splits, vec4f(1.0)), input.layers, input.overlap, vec2f(0.0));
    let last = layered_variance_last_layer(layers, depth);
    var sums = vec2f(0.0);
    for (var plane = 0u; plane < 8u; plane++) {
        let lower = convolution_receiver(depth, input.terms, true);
        let series = convolution_receiver(depth, input.terms, false);
        sums += vec2f(
            convolution_plane(texel, stored_as, plane, input.terms, lower, input.damping),
            convolution_plane(texel, stored_as, plane, input.terms, series, input.damping),
        );
    }
    let moments = two_moments_from_texel(texel, stored_as).xy;
    return BatchOutput(array<vec4f, 3>(
        vec4f(
            chebyshev_shadow_intensity_of_texel(texel, depth, stored_as),
            chebyshev_upper_bound(moments, clamp(depth, -1.0, 1.0), two_moments_smallest_variance_of(stored_as)),
            layered_variance_shadow_intensity_of_plane(texel, depth, stored_as, layers, 0u),
            layered_variance_shadow_intensity_of_plane(texel, depth, stored_as, layers, last / 2u),
        ),
        vec4f(
            f32(last) / 8.0,
            exponential_shadow_intensity_of_texel(texel, depth, stored_as, exponents.x, false),
            exponential_shadow_intensity_of_texel(texel, depth, stored_as, exponents.x, true),
            exponential_variance_shadow_intensity_of_texel(texel, depth, stored_as, exponents, false),
        ),
        vec4f(
            exponential_variance_shadow_intensity_of_texel(texel, depth, stored_as, exponents, true),
            convolution_shadow_intensity(sums.x, input.terms, true),
            convolution_shadow_intensity(sums.y, input.terms, false),
            hausdorff4_shadow_intensity_of_texel(texel, depth, stored_as),
        ),
    ));
}
