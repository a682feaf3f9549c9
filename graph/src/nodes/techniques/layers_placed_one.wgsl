import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers};
import node::specialization::{GROUP, LAYERS, LAYER_OVERLAP};

// Layers that are placed on the device, of the one layer of the map that a pass is recorded for.

@group(GROUP) @binding(5) var splits_map: texture_2d<f32>;

fn technique_layers(map_layer: u32) -> LayeredVarianceLayers {
    let low = textureLoad(splits_map, vec2u(0u, 0u), 0);
    let high = textureLoad(splits_map, vec2u(1u, 0u), 0);
    return LayeredVarianceLayers(array<vec4f, 2>(low, high), LAYERS, LAYER_OVERLAP, vec2f(0.0));
}
