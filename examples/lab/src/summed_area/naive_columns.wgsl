// The usual way, second half: prefix sums of the columns, one column per invocation.

@group(0) @binding(0) var row_prefixes: texture_2d<u32>;
@group(0) @binding(1) var table: texture_storage_2d<rgba32uint, write>;

@compute @workgroup_size(64)
fn sum_columns(@builtin(global_invocation_id) id: vec3u) {
    let size = textureDimensions(row_prefixes);
    if id.x >= size.x {
        return;
    }
    var sum = vec4u(0u);
    for (var y = 0u; y < size.y; y++) {
        sum += textureLoad(row_prefixes, vec2u(id.x, y), 0);
        textureStore(table, vec2u(id.x, y), sum);
    }
}
