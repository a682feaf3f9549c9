import moment_shadows::blur_target::{blur_store, blurred_map, moments_map};
import moment_shadows::specialization::{AXIS, OUTPUTS, WORKGROUP_X, WORKGROUP_Y, blur_block};

// One direction of a separable filter over one layer, with weights that are known when the graph is compiled.
// An invocation makes OUTPUTS texels in a row along AXIS, out of texels that it loads once.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn blur(@builtin(global_invocation_id) id: vec3u) {
    let last = vec2i(textureDimensions(blurred_map)) - 1;
    let first = vec2i(id.xy) * (1 + (OUTPUTS - 1) * AXIS);
    if any(first > last) {
        return;
    }
    let block = blur_block(moments_map, first, last);
    blur_store(first, last, block[0]);
    blur_store(first + AXIS, last, block[1]);
    blur_store(first + 2 * AXIS, last, block[2]);
    blur_store(first + 3 * AXIS, last, block[3]);
    blur_store(first + 4 * AXIS, last, block[4]);
    blur_store(first + 5 * AXIS, last, block[5]);
    blur_store(first + 6 * AXIS, last, block[6]);
    blur_store(first + 7 * AXIS, last, block[7]);
}
