import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers};
import node::specialization::{LAYERS, LAYER_OVERLAP, LAYER_SPLITS_HIGH, LAYER_SPLITS_LOW};

// Layers that are known when the graph is compiled: the same for all layers of the map.

fn technique_layers(map_layer: u32) -> LayeredVarianceLayers {
    return LayeredVarianceLayers(array<vec4f, 2>(LAYER_SPLITS_LOW, LAYER_SPLITS_HIGH), LAYERS, LAYER_OVERLAP, vec2f(0.0));
}
