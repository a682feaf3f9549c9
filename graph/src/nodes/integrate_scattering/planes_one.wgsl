import node::map_filtering::{filtering_texel};
import node::specialization::{GROUP, MomentsStorage};

// Texels of maps of one plane.

@group(GROUP) @binding(1) var rectified_map: texture_2d<f32>;
@group(GROUP) @binding(2) var integrated_map: MomentsStorage;

alias Planes = vec4f;

fn planes_load(column: u32, row: u32) -> Planes {
    return textureLoad(rectified_map, vec2u(column, row), 0);
}

fn planes_store(column: u32, row: u32, means: Planes) {
    textureStore(integrated_map, vec2u(column, row), filtering_texel(means));
}

// weight * texels + sum.
fn planes_fma(weight: f32, texels: Planes, sum: Planes) -> Planes {
    return fma(vec4f(weight), texels, sum);
}

fn planes_divide(sum: Planes, weight: f32) -> Planes {
    return sum / weight;
}

// The texels on a condition, or else zeros.
fn planes_if(texels: Planes, condition: bool) -> Planes {
    return select(vec4f(0.0), texels, condition);
}
