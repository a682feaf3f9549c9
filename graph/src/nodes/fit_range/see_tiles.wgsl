import node::camera_depth::{camera_depth_at, camera_depth_size};
import node::specialization::{GROUP, SEEN_TILE};
import node::views::{views};

// The least and the largest stored depth of surfaces in each tile of the camera's picture, and the picture's size. Where the first is
// larger there are none.

@group(GROUP) @binding(3) var target_map: texture_storage_2d<rgba32float, write>;

// Stored depths as bits: they are not negative, so that they have the same order.
var<workgroup> least: atomic<u32>;
var<workgroup> most: atomic<u32>;

@compute @workgroup_size(SEEN_TILE, SEEN_TILE)
fn see_tiles(@builtin(local_invocation_index) index: u32, @builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) tile: vec3u) {
    if index == 0u {
        // Above 1, and a number.
        atomicStore(&least, bitcast<u32>(2.0));
    }
    workgroupBarrier();
    let size = camera_depth_size();
    // Beyond the picture the nearest pixel is loaded again.
    let pixel = min(vec2i(SEEN_TILE * tile.xy + local.xy), size - 1);
    let stored_depth = camera_depth_at(pixel);
    if stored_depth != views[0].far_depth {
        let bits = bitcast<u32>(abs(stored_depth));
        atomicMin(&least, bits);
        atomicMax(&most, bits);
    }
    workgroupBarrier();
    if index == 0u {
        let ends = vec2f(bitcast<f32>(atomicLoad(&least)), bitcast<f32>(atomicLoad(&most)));
        textureStore(target_map, tile.xy, vec4f(ends, vec2f(size)));
    }
}
