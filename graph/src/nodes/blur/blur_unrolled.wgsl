import node::blur_target::{blur_store, blurred_map, moments_map};
import node::blur_unrolled::{OUTPUTS, blur_block};
import node::region_tile::{region_tile};
import node::specialization::{AXIS, WORKGROUP_X, WORKGROUP_Y};

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
    let block = blur_block(moments_map, first, low, last);
    blur_store(first, last, block[0]);
    blur_store(first + AXIS, last, block[1]);
    blur_store(first + 2 * AXIS, last, block[2]);
    blur_store(first + 3 * AXIS, last, block[3]);
    blur_store(first + 4 * AXIS, last, block[4]);
    blur_store(first + 5 * AXIS, last, block[5]);
    blur_store(first + 6 * AXIS, last, block[6]);
    blur_store(first + 7 * AXIS, last, block[7]);
}
