import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import node::regions::{region_at};
import node::seen::{NOTHING_SEEN, seen_conversion, seen_end};
import node::specialization::{DepthTexture, GROUP, REGIONS, SAMPLES};

// The range of each region of one layer of a depth map, in three passes: the nearest and the farthest caster that each workgroup
// sees; those of all workgroups, and with them the ranges; a copy, since no pass may read what it writes.
//
// Where the camera's depth is known, a range ends with the farthest surface that the camera sees: casters behind that are behind
// whatever is shaded, and behind it they stay at the far end. It begins with the nearest caster all the same: one that is moved
// towards what is seen would come as close to it as light leaks, and soft shadows take their width from where casters are.
//
// Ranges are a texel per region: the middle, how many times the host's range is as long, and the region's first texel. A texture
// of zeros holds none. Both ends lie on a grid whose step is a share of the range, so that what moves slowly changes them seldom.

@group(GROUP) @binding(1) var depth_map: DepthTexture;
@group(GROUP) @binding(2) var ranges_map: texture_2d<f32>;
@group(GROUP) @binding(3) var target_map: texture_storage_2d<rgba32float, write>;
@group(GROUP) @binding(5) var ends_map: texture_2d<f32>;

// Texels of a piece of a layer, along each side: one per invocation.
const SIDE: u32 = 16u;
const INVOCATIONS: u32 = 256u;

// The parts of the casters' depth that a range goes on behind the last of them and in front of the first when it is made. A receiver
// behind has to lie behind the last caster by more than what its bound leaks: at least 3/128, 0.047 in moment depth, farther
// than a single occluder leaks that is stored in 16-bit numbers. Casters may move through all of the front and what is left behind
// before the range has to grow.
const ROOM_BEHIND: f32 = 0.0546875;
const LEAST_BEHIND: f32 = 0.0234375;
const ROOM_IN_FRONT: f32 = 0.015625;

// Steps of the grid in the range, at least.
const STEPS: f32 = 128.0;

// By how much the range may be longer than one that is made anew: after something has left.
const LONGEST: f32 = 1.125;

// The shortest range, in moment depth: 1/512 of the host's. A shorter one would consist of rounding errors.
const SHORTEST: f32 = 0.00390625;

// No casters: the nearest end behind the farthest.
const NO_CASTER = vec2f(2.0, -2.0);

// Neither casters nor anything that is seen: both ends of casters, and the farthest surface that the camera sees.
const NO_ENDS = vec3f(NO_CASTER, NOTHING_SEEN);

var<workgroup> partial_ends: array<vec3f, INVOCATIONS>;

fn both_ends(first: vec3f, second: vec3f) -> vec3f {
    return vec3f(min(first.x, second.x), max(first.yz, second.yz));
}

// The ends over all invocations, in the first of them.
fn ends_of_workgroup(index: u32, own: vec3f) -> vec3f {
    workgroupBarrier();
    partial_ends[index] = own;
    for (var reach = INVOCATIONS / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if index < reach {
            partial_ends[index] = both_ends(partial_ends[index], partial_ends[index + reach]);
        }
    }
    return partial_ends[index];
}

// The ends of a texel's casters. The far end holds none.
fn ends_of_texel(texel: vec2u, conversion: DepthConversion) -> vec3f {
    var ends = NO_ENDS;
    // For a single sample the last argument of the load is its mip level, 0.
    for (var sample = 0; sample < SAMPLES; sample++) {
        let z = depth_to_moment_depth(vec4f(textureLoad(depth_map, vec2i(texel), sample)).x, conversion);
        if z < 1.0 {
            ends = both_ends(ends, vec3f(z, z, NOTHING_SEEN));
        }
    }
    return ends;
}

// Workgroups take turns with the regions, and share the blocks of each: the number of workgroups does not depend on where
// regions lie, and each says one thing.
@compute @workgroup_size(16, 16)
fn find_ends(@builtin(local_invocation_id) local: vec3u, @builtin(local_invocation_index) index: u32, @builtin(workgroup_id) workgroup_id: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let own = workgroup_id.y * workgroups.x + workgroup_id.x;
    let number = own % REGIONS;
    let shared_by = max((workgroups.x * workgroups.y) / REGIONS, 1u);
    let region = region_at(number, textureDimensions(depth_map), 0u);
    let blocks = (region.extent + SIDE - 1u) / SIDE;
    let conversion = seen_conversion(number);
    // Invocations share what is seen, too.
    var ends = vec3f(NO_CASTER, seen_end(number, (own / REGIONS) * INVOCATIONS + index, shared_by * INVOCATIONS));
    for (var piece = own / REGIONS; piece < blocks.x * blocks.y; piece += shared_by) {
        let texel = vec2u(piece % blocks.x, piece / blocks.x) * SIDE + local.xy;
        if all(texel < region.extent) {
            ends = both_ends(ends, ends_of_texel(region.origin + texel, conversion));
        }
    }
    let total = ends_of_workgroup(index, ends);
    if index == 0u {
        textureStore(target_map, workgroup_id.xy, vec4f(total, 0.0));
    }
}

// The ends of a region, in the first invocation.
fn ends_of_region(number: u32, index: u32) -> vec3f {
    let size = textureDimensions(ends_map);
    var ends = NO_ENDS;
    for (var own = number + index * REGIONS; own < size.x * size.y; own += INVOCATIONS * REGIONS) {
        ends = both_ends(ends, textureLoad(ends_map, vec2u(own % size.x, own / size.x), 0).xyz);
    }
    return ends_of_workgroup(index, ends);
}

// The largest power of two that is no larger than `value`, which is positive and normal.
fn power_of_two(value: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(value) & 0x7f800000u);
}

// The range from so far in front of the casters to so far behind them, parts of their depth, that the host's range allows.
fn range_around(casters: vec2f, in_front: f32, behind: f32) -> vec2f {
    let depth = max(casters.y - casters.x, SHORTEST);
    let far = min(fma(1.0 + behind, depth, casters.x), 1.0);
    return vec2f(max(min(fma(-in_front, depth, casters.x), far - SHORTEST), -1.0), far);
}

// A range whose ends are moved outwards to the grid.
fn on_grid(ends: vec2f) -> vec2f {
    let step = power_of_two(ends.y - ends.x) / STEPS;
    return clamp(vec2f(floor(ends.x / step), ceil(ends.y / step)) * step, vec2f(-1.0), vec2f(1.0));
}

// The ends of the range for casters between `casters`, where it had the ends `before`. It grows at once, to where a new one would
// end, and shrinks where it is clearly too long. Where the host's range has moved, one end is too near and the other one too far away by an
// eighth: both are made anew then, on the same grid, so that the range is what it was.
fn fitted(casters: vec2f, before: vec2f) -> vec2f {
    let made = on_grid(range_around(casters, ROOM_IN_FRONT, ROOM_BEHIND));
    let length = made.y - made.x;
    let needed = range_around(casters, 0.0, LEAST_BEHIND);
    let before_front = before.x > needed.x;
    let moved = made.x - before.x > 0.0625 * length;
    let grown = select(before, made, vec2<bool>(before_front || moved, before_front || needed.y > before.y));
    return select(grown, made, grown.y - grown.x > LONGEST * length);
}

@compute @workgroup_size(256)
fn fit_ranges(@builtin(local_invocation_index) index: u32) {
    for (var number = 0u; number < REGIONS; number++) {
        let ends = ends_of_region(number, index);
        if index == 0u {
            let texel = textureLoad(ranges_map, vec2u(number, 0u), 0);
            textureStore(target_map, vec2u(number, 0u), range_of_region(number, ends, texel));
        }
    }
}

// The next texel of a region, after `before`.
fn range_of_region(number: u32, found: vec3f, before: vec4f) -> vec4f {
    let region = region_at(number, textureDimensions(depth_map), 0u);
    if any(region.extent == vec2u(0u)) {
        // No region: its place is none.
        return vec4f(0.0, 1.0, -1.0, -1.0);
    }
    let origin = vec2f(region.origin);
    if found.x > found.y || found.z == NOTHING_SEEN {
        // Nothing to see, and the range stays as it is, for what comes back.
        return vec4f(before.x, max(before.y, 1.0), origin);
    }
    // Without a range before, or with that of another region, there is none to grow.
    let known = before.y >= 1.0 && all(before.zw == origin);
    let half = 1.0 / max(before.y, 1.0);
    let ends_before = select(NO_CASTER, before.x + vec2f(-half, half), known);
    // Where all that is seen lies before the casters, none of it is in shadow.
    let casters = vec2f(found.x, clamp(found.z, found.x, found.y));
    let ends = fitted(casters, ends_before);
    if all(ends == ends_before) {
        // To the bit, frame after frame.
        return before;
    }
    return vec4f(0.5 * (ends.x + ends.y), max(2.0 / (ends.y - ends.x), 1.0), origin);
}

@compute @workgroup_size(64)
fn keep_ranges(@builtin(local_invocation_index) index: u32) {
    for (var number = index; number < REGIONS; number += 64u) {
        textureStore(target_map, vec2u(number, 0u), textureLoad(ranges_map, vec2u(number, 0u), 0));
    }
}
