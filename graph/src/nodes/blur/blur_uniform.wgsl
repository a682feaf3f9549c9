import node::blur_parameters::{parameters};
import node::blur_target::{blur_store, blurred_map, moments_map};
import node::blur_unrolled::{BlurSums, OUTPUTS, blur_outputs, blur_taps};
import node::region_tile::{region_tile};
import node::specialization::{AXIS, WORKGROUP_X, WORKGROUP_Y};

// One direction of a separable filter over the regions of one layer, with weights that a host can change per frame.
// An invocation makes OUTPUTS texels in a row along AXIS; it runs through the texels in blocks of 16 and through the
// weights in step, keeping the half that the next block needs again.

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
    var sums: BlurSums;
    var w0 = parameters.weights[0];
    var w1 = parameters.weights[1];
    var w2 = parameters.weights[2];
    var w3 = parameters.weights[3];
    // 40 vectors of weights hold 9 blocks.
    let blocks = min(parameters.blocks, 9u);
    for (var block = 0u; block < blocks; block++) {
        let w4 = parameters.weights[4u * block + 4u];
        let w5 = parameters.weights[4u * block + 5u];
        let w6 = parameters.weights[4u * block + 6u];
        let w7 = parameters.weights[4u * block + 7u];
        let tap = i32(16u * block) - i32(parameters.radius);
        sums = blur_taps(moments_map, first + tap * AXIS, low, last, sums, w0, w1, w2, w3, w4, w5, w6, w7);
        w0 = w4;
        w1 = w5;
        w2 = w6;
        w3 = w7;
    }
    let block = blur_outputs(sums);
    blur_store(first, last, block[0]);
    blur_store(first + AXIS, last, block[1]);
    blur_store(first + 2 * AXIS, last, block[2]);
    blur_store(first + 3 * AXIS, last, block[3]);
    blur_store(first + 4 * AXIS, last, block[4]);
    blur_store(first + 5 * AXIS, last, block[5]);
    blur_store(first + 6 * AXIS, last, block[6]);
    blur_store(first + 7 * AXIS, last, block[7]);
    blur_store(first + 8 * AXIS, last, block[8]);
    blur_store(first + 9 * AXIS, last, block[9]);
    blur_store(first + 10 * AXIS, last, block[10]);
    blur_store(first + 11 * AXIS, last, block[11]);
    blur_store(first + 12 * AXIS, last, block[12]);
    blur_store(first + 13 * AXIS, last, block[13]);
    blur_store(first + 14 * AXIS, last, block[14]);
    blur_store(first + 15 * AXIS, last, block[15]);
}
