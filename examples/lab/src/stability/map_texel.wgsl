import node::specialization::{PLANES};
import node::technique_receiver::{TechniqueReceiver};

// The filtered texels of all planes of a map, in place of a texture.
var<private> filtered_texels: array<vec4f, PLANES>;

fn map_texel(receiver: TechniqueReceiver, plane: u32) -> vec4f {
    return filtered_texels[plane];
}
