import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_of_unorm16};

// The usual way, first half: prefix sums of the rows of a unorm16 map, one row per invocation.

@group(0) @binding(0) var moments_map: texture_2d<f32>;
@group(0) @binding(1) var row_prefixes: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn sum_rows(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(moments_map);
    if id.x >= size.y {
        return;
    }
    var sum = vec4u(0u);
    for (var x = 0u; x < size.x; x++) {
        sum += summed_area_encoding_of_unorm16(textureLoad(moments_map, vec2u(x, id.x), 0));
        textureStore(row_prefixes, vec2u(x, id.x), sum);
    }
}
