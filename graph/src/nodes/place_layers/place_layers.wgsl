import moment_shadows::map::depth::{DepthConversion, depth_to_moment_depth};
import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers};
import moment_shadows::techniques::lloyd::{LloydState, lloyd_contribution, lloyd_step};
import node::regions::{region_at};
import node::specialization::{DepthTexture, GROUP, LAYERS, REGIONS};

// One step of Lloyd relaxation per frame for the splits of one layer of a map, in three passes: sums over the footprints
// of tiles; the sum of these sums, which moves two splits; a copy, since no pass may read what it writes.
//
// The state is five texels in a row: the splits (two), the weights of their cells (two), and the split that is moved next
// (x) with whether there is a state at all (y). A texture of zeros holds no state.

@group(GROUP) @binding(0) var<uniform> conversions: array<DepthConversion, REGIONS>;
@group(GROUP) @binding(1) var depth_map: DepthTexture;
@group(GROUP) @binding(2) var state_map: texture_2d<f32>;
@group(GROUP) @binding(3) var target_map: texture_storage_2d<rgba32float, write>;
@group(GROUP) @binding(5) var sums_map: texture_2d<f32>;
@group(GROUP) @binding(6) var splits_map: texture_storage_2d<rgba32float, write>;

// Footprints that a workgroup sums up, along each side: two by two per invocation.
const TILE: u32 = 32u;

// Invocations of a workgroup along each side, and all of them.
const SIDE: u32 = 16u;
const INVOCATIONS: u32 = 256u;

struct PlacedState {
    state: LloydState,
    // The split that is moved next, together with the one after it.
    first: u32,
}

// Without a state the layers are of equal depth; what follows the last split is not read.
fn state_at_first() -> PlacedState {
    var splits = array<vec4f, 2>(vec4f(1.0), vec4f(1.0));
    for (var split = 0u; split + 1u < LAYERS; split++) {
        splits[split / 4u][split % 4u] = 2.0 * f32(split + 1u) / f32(LAYERS) - 1.0;
    }
    let layers = LayeredVarianceLayers(splits, LAYERS, 0.0, vec2f(0.0));
    return PlacedState(LloydState(layers, array<vec4f, 2>()), 0u);
}

fn state_before() -> PlacedState {
    let rest = textureLoad(state_map, vec2u(4u, 0u), 0);
    if rest.y == 0.0 {
        return state_at_first();
    }
    let splits = array<vec4f, 2>(textureLoad(state_map, vec2u(0u, 0u), 0), textureLoad(state_map, vec2u(1u, 0u), 0));
    let weights = array<vec4f, 2>(textureLoad(state_map, vec2u(2u, 0u), 0), textureLoad(state_map, vec2u(3u, 0u), 0));
    return PlacedState(LloydState(LayeredVarianceLayers(splits, LAYERS, 0.0, vec2f(0.0)), weights), u32(rest.x));
}

var<workgroup> partial_sums: array<vec4f, INVOCATIONS>;

// The sum over all invocations, in the first of them.
fn sum_of_workgroup(index: u32, own: vec4f) -> vec4f {
    partial_sums[index] = own;
    for (var reach = INVOCATIONS / 2u; reach > 0u; reach /= 2u) {
        workgroupBarrier();
        if index < reach {
            partial_sums[index] += partial_sums[index + reach];
        }
    }
    return partial_sums[index];
}

// Samples of a texel lie elsewhere each, but the first ones of all texels lie on one grid, which is all that a footprint
// needs. For a single sample the last argument of the load is its mip level, 0.
fn depth_at(texel: vec2u, conversion: DepthConversion) -> f32 {
    return depth_to_moment_depth(vec4f(textureLoad(depth_map, vec2i(texel), 0)).x, conversion);
}

// What the footprint of a texel, the next one to the right and the two below adds. It lies within one region or does not
// count: two regions have no edge in common.
fn footprint_sums(texel: vec2u, size: vec2u, placed: PlacedState) -> vec4f {
    var sums = vec4f(0.0);
    for (var number = 0u; number < REGIONS; number++) {
        let region = region_at(number, size, 0u);
        if any(texel < region.origin) || any(texel + 1u >= region.origin + region.extent) {
            continue;
        }
        let conversion = conversions[number];
        let depths = vec4f(
            depth_at(texel, conversion),
            depth_at(texel + vec2u(1u, 0u), conversion),
            depth_at(texel + vec2u(0u, 1u), conversion),
            depth_at(texel + vec2u(1u, 1u), conversion),
        );
        // Where the farther surface is the far end, nothing lies behind it that light could bleed onto.
        if all(depths < vec4f(1.0)) {
            sums += lloyd_contribution(placed.state.layers, placed.first, depths);
        }
    }
    return sums;
}

// The sums of a tile, to the texel of its workgroup.
@compute @workgroup_size(16, 16)
fn sum_tiles(@builtin(local_invocation_id) local: vec3u, @builtin(local_invocation_index) index: u32, @builtin(workgroup_id) workgroup_id: vec3u) {
    let size = textureDimensions(depth_map);
    let placed = state_before();
    let place = workgroup_id.xy * TILE + local.xy;
    var sums = vec4f(0.0);
    for (var part = 0u; part < 4u; part++) {
        sums += footprint_sums(place + SIDE * vec2u(part % 2u, part / 2u), size, placed);
    }
    let total = sum_of_workgroup(index, sums);
    if index == 0u {
        textureStore(target_map, workgroup_id.xy, total);
    }
}

// The sums of all tiles, and with them the next state.
@compute @workgroup_size(256)
fn step_splits(@builtin(local_invocation_index) index: u32) {
    let tiles = textureDimensions(sums_map);
    var sums = vec4f(0.0);
    for (var tile = index; tile < tiles.x * tiles.y; tile += INVOCATIONS) {
        sums += textureLoad(sums_map, vec2u(tile % tiles.x, tile / tiles.x), 0);
    }
    let total = sum_of_workgroup(index, sums);
    if index == 0u {
        let placed = state_before();
        let state = lloyd_step(placed.state, placed.first, total);
        let splits = max(LAYERS, 2u) - 1u;
        textureStore(target_map, vec2u(0u, 0u), state.layers.splits[0]);
        textureStore(target_map, vec2u(1u, 0u), state.layers.splits[1]);
        textureStore(target_map, vec2u(2u, 0u), state.weights[0]);
        textureStore(target_map, vec2u(3u, 0u), state.weights[1]);
        textureStore(target_map, vec2u(4u, 0u), vec4f(f32((placed.first + 2u) % splits), 1.0, 0.0, 0.0));
    }
}

// The next state becomes that of the next frame, and its splits are given out.
@compute @workgroup_size(8)
fn keep_splits(@builtin(local_invocation_index) index: u32) {
    if index < 5u {
        let texel = textureLoad(state_map, vec2u(index, 0u), 0);
        textureStore(target_map, vec2u(index, 0u), texel);
        if index < 2u {
            textureStore(splits_map, vec2u(index, 0u), texel);
        }
    }
}
