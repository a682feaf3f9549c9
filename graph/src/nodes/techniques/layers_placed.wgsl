import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers};
import node::specialization::{GROUP, LAYERS, LAYER_OVERLAP};

// Layers that are placed on the device: the splits are two texels in each layer of a texture of their own.

@group(GROUP) @binding(5) var splits_map: texture_2d_array<f32>;

fn technique_layers(map_layer: u32) -> LayeredVarianceLayers {
    let low = textureLoad(splits_map, vec2u(0u, 0u), map_layer, 0);
    let high = textureLoad(splits_map, vec2u(1u, 0u), map_layer, 0);
    return LayeredVarianceLayers(array<vec4f, 2>(low, high), LAYERS, LAYER_OVERLAP, vec2f(0.0));
}
