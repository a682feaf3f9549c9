import moment_shadows::map::depth::{DepthConversion};
import node::specialization::{GROUP, SEEN_TILE};
import node::views::{views};

// What the camera sees, from the tiles of its picture (see_tiles.wgsl).

@group(GROUP) @binding(6) var tiles_map: texture_2d_array<f32>;

// Less than any end.
const NOTHING_SEEN = -2.0;

// By how much results may be off that cancel, as a part of their terms.
const ROUNDING: f32 = 1e-5;

// How a region's map stores depth.
fn seen_conversion(number: u32) -> DepthConversion {
    return views[number].conversion;
}

// The farthest moment depth of what a tile shows of a region. That lies between eight corners, of which moment depth is largest at one;
// where all of them lie beyond one side of the region, it shows nothing.
fn seen_end_of_tile(number: u32, tile: vec2u) -> f32 {
    let texel = textureLoad(tiles_map, tile, 0, 0);
    if texel.x > texel.y {
        return NOTHING_SEEN;
    }
    let low = vec2f(tile * SEEN_TILE) / texel.zw;
    let high = min(vec2f((tile + 1u) * SEEN_TILE) / texel.zw, vec2f(1.0));
    let matrix = views[number].light_from_camera;
    let magnitudes = mat4x4f(abs(matrix[0]), abs(matrix[1]), abs(matrix[2]), abs(matrix[3]));
    // The largest of: x, y, w - x, w - y; of w; and of moment depth.
    var across = vec4f(-1e38);
    var along = -1e38;
    var end = NOTHING_SEEN;
    for (var corner = 0u; corner < 8u; corner++) {
        let uv = select(low, high, vec2<bool>((corner & 1u) != 0u, (corner & 2u) != 0u));
        let clip = vec4f(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, select(texel.x, texel.y, (corner & 4u) != 0u), 1.0);
        let light = matrix * clip;
        let terms = magnitudes * abs(clip);
        let slack = ROUNDING * (terms.xy + terms.z);
        across = max(across, vec4f(light.xy, light.z - light.xy) + slack.xyxy);
        along = max(along, light.z);
        end = max(end, light.w / max(dot(views[number].scene_w_from_camera, clip), 1e-30));
    }
    let seen = along > 0.0 && all(across >= vec4f(0.0));
    return select(NOTHING_SEEN, clamp(end, -1.0, 1.0), seen);
}

// The farthest moment depth of what is seen of a region, in every so many tiles from `first` on.
fn seen_end(number: u32, first: u32, step: u32) -> f32 {
    let tiles = textureDimensions(tiles_map);
    var end = NOTHING_SEEN;
    for (var tile = first; tile < tiles.x * tiles.y; tile += step) {
        end = max(end, seen_end_of_tile(number, vec2u(tile % tiles.x, tile / tiles.x)));
    }
    return end;
}
