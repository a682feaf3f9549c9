import node::specialization::{EXTENT, GROUP};

// No view rays.

@group(GROUP) @binding(7) var<storage, read_write> view_ray_codes: array<vec2u>;

@compute @workgroup_size(8, 8)
fn clear_codes(@builtin(global_invocation_id) id: vec3u) {
    if all(id.xy < EXTENT) {
        view_ray_codes[id.y * EXTENT.x + id.x] = vec2u(0u);
    }
}
