import node::map_filtering::{filtering_texel};
import node::specialization::{GROUP, MomentsStorage};

// Texels of maps of two planes, which take the same weights.

@group(GROUP) @binding(1) var rectified_map: texture_2d_array<f32>;
@group(GROUP) @binding(2) var integrated_map: MomentsStorage;
@group(GROUP) @binding(3) var integrated_second: MomentsStorage;

alias Planes = mat2x4f;

fn planes_load(column: u32, row: u32) -> Planes {
    let place = vec2u(column, row);
    return Planes(textureLoad(rectified_map, place, 0, 0), textureLoad(rectified_map, place, 1, 0));
}

fn planes_store(column: u32, row: u32, means: Planes) {
    textureStore(integrated_map, vec2u(column, row), filtering_texel(means[0]));
    textureStore(integrated_second, vec2u(column, row), filtering_texel(means[1]));
}

// weight * texels + sum.
fn planes_fma(weight: f32, texels: Planes, sum: Planes) -> Planes {
    let factor = vec4f(weight);
    return Planes(fma(factor, texels[0], sum[0]), fma(factor, texels[1], sum[1]));
}

fn planes_divide(sum: Planes, weight: f32) -> Planes {
    return Planes(sum[0] / weight, sum[1] / weight);
}

// The texels on a condition, or else zeros.
fn planes_if(texels: Planes, condition: bool) -> Planes {
    return Planes(select(vec4f(0.0), texels[0], condition), select(vec4f(0.0), texels[1], condition));
}
