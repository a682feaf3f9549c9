import node::blur_outputs::{blur_outputs};
import node::blur_target::{written_map};
import node::regions::{region_tile};
import node::specialization::{AXIS, OUTPUTS, WORKGROUP_X, WORKGROUP_Y};

// One direction of a separable filter over the regions of one layer: an invocation makes OUTPUTS texels in a row along AXIS.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn write_map(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let outputs = vec2u(1 + (OUTPUTS - 1) * AXIS);
    let tile = region_tile(workgroup_id, workgroups, textureDimensions(written_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * outputs);
    let place = tile.first + local.xy * outputs;
    if any(place >= tile.region.extent) {
        return;
    }
    let low = vec2i(tile.region.origin);
    blur_outputs(low + vec2i(place), low, low + vec2i(tile.region.extent) - 1, tile.number);
}
