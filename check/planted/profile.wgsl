// An error under core WebGPU: 16-bit normalised formats are an optional feature.

@group(0) @binding(0) var moments_map: texture_storage_2d<rgba16unorm, write>;

@compute @workgroup_size(8, 8)
fn clear(@builtin(global_invocation_id) id: vec3u) {
    textureStore(moments_map, id.xy, vec4f(0.0));
}
