import node::blur_target::{blur_store, blurred_map, moments_map};
import node::blur_unrolled::{blur_block};
import node::region_tile::{region_tile};
import node::specialization::{AXIS, OUTPUTS, WORKGROUP_X, WORKGROUP_Y};

// One direction of a separable filter over the regions of one layer, with weights that are known when the graph is compiled.
// An invocation makes OUTPUTS texels in a row along AXIS, out of texels that it loads once.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn blur(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let outputs = vec2u(1 + (OUTPUTS - 1) * AXIS);
    let tile = region_tile(workgroup, workgroups, textureDimensions(blurred_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * outputs);
    let place = tile.first + local.xy * outputs;
    if any(place >= tile.region.extent) {
        return;
    }
    let low = vec2i(tile.region.origin);
    let last = low + vec2i(tile.region.extent) - 1;
    let first = low + vec2i(place);
    blur_store(first, last, blur_block(moments_map, first, low, last));
}
