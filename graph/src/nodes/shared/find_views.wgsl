import node::camera_depth::{camera_depth_at, camera_depth_clip, camera_depth_pixel, camera_depth_size};
import moment_shadows::map::map_region::{map_region_within};
import node::specialization::{GROUP, TILE, VIEWS};
import node::technique_map::{technique_map_size};
import node::views::{views};

// Which views may contain a pixel of a tile: a view is left out where all eight corners of what the tile shows, between its nearest
// and its farthest surface, lie beyond one side of the view. A workgroup makes a tile, and each invocation loads a pixel and tests a view.

@group(GROUP) @binding(8) var found_views: texture_storage_2d<rgba32uint, write>;

// The view that is the first bit.
override FIRST_VIEW: u32 = 0u;

// Stored depths as bits: they are not negative, so that they have the same order.
var<workgroup> least: atomic<u32>;
var<workgroup> most: atomic<u32>;
var<workgroup> found: array<atomic<u32>, 4>;

// By how much results may be off that cancel, as a part of their terms.
const ROUNDING: f32 = 1e-5;

// Whether a view may contain a place between two pixels and two stored depths.
fn may_contain(view: u32, first: vec2i, last: vec2i, nearest: f32, farthest: f32) -> bool {
    let region = map_region_within(views[view].region, technique_map_size());
    // Half a texel less, for rounding. Wider than the region it leaves nothing.
    let guard = max(views[view].guard - 0.5, 0.0) / max(vec2f(region.extent), vec2f(1.0));
    // The largest of: w, x - guard w, (1 - guard) w - x, and the same of y.
    var across = vec4f(-1e38);
    var along = -1e38;
    for (var corner = 0u; corner < 8u; corner++) {
        let pixel = select(first, last, vec2<bool>((corner & 1u) != 0u, (corner & 2u) != 0u));
        // Of the pixels at the ends whole ones.
        let beyond = vec2f(select(-1.0, 1.0, (corner & 1u) != 0u), select(1.0, -1.0, (corner & 2u) != 0u)) / vec2f(camera_depth_size());
        let clip = camera_depth_clip(camera_depth_pixel(pixel), select(nearest, farthest, (corner & 4u) != 0u)) + vec4f(beyond, 0.0, 0.0);
        let matrix = views[view].light_from_camera;
        let light = matrix * clip;
        let terms = mat4x4f(abs(matrix[0]), abs(matrix[1]), abs(matrix[2]), abs(matrix[3])) * abs(clip);
        let slack = ROUNDING * (terms.xy + terms.z);
        across = max(across, vec4f(light.xy - guard * light.z, (1.0 - guard) * light.z - light.xy) + slack.xyxy);
        along = max(along, light.z);
    }
    return all(region.extent > vec2u(0u)) && along > 0.0 && all(across >= vec4f(0.0));
}

@compute @workgroup_size(TILE, TILE)
fn find_views(@builtin(local_invocation_index) index: u32, @builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) tile: vec3u) {
    if index == 0u {
        atomicStore(&least, 0xffffffffu);
    }
    workgroupBarrier();
    let first = TILE * vec2i(tile.xy);
    let last = min(first + TILE, camera_depth_size()) - 1;
    // Beyond the picture the nearest pixel is loaded again.
    let stored_depth = camera_depth_at(min(first + vec2i(local.xy), last));
    if stored_depth != views[0].far_depth {
        let bits = bitcast<u32>(abs(stored_depth));
        atomicMin(&least, bits);
        atomicMax(&most, bits);
    }
    workgroupBarrier();
    let view = FIRST_VIEW + index;
    let nearest = atomicLoad(&least);
    let farthest = atomicLoad(&most);
    if index < 128u && view < VIEWS && nearest <= farthest {
        if may_contain(view, first, last, bitcast<f32>(nearest), bitcast<f32>(farthest)) {
            atomicOr(&found[index / 32u], 1u << (index % 32u));
        }
    }
    workgroupBarrier();
    if index == 0u {
        let words = vec4u(atomicLoad(&found[0]), atomicLoad(&found[1]), atomicLoad(&found[2]), atomicLoad(&found[3]));
        textureStore(found_views, vec2i(tile.xy), words);
    }
}
