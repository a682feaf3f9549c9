import node::rectify_parameters::{parameters};
import node::specialization::{EXTENT, GROUP};
import moment_shadows::air::view_rays::{VIEW_RAYS_ROWS, view_rays_texel};

// Which view rays pass each texel and which end there, by the maxima of codes from each column on: a workgroup per row, a stretch
// of it per invocation, the maxima of invocations by the scan of Hillis and Steele (1986).

@group(GROUP) @binding(7) var<storage, read_write> view_ray_codes: array<vec2u>;
@group(GROUP) @binding(8) var view_rays_map: texture_storage_2d<rg32uint, write>;

const THREADS = 64u;

var<workgroup> maxima: array<vec2u, THREADS>;

// The codes of view rays that end in a column of a row.
fn codes_of(column: u32, row: u32) -> vec2u {
    return view_ray_codes[row * EXTENT.x + min(column, EXTENT.x - 1u)];
}

// And of the rows around.
fn codes_about(column: u32, row: u32) -> vec2u {
    var codes = vec2u(0u);
    for (var other = -VIEW_RAYS_ROWS; other <= VIEW_RAYS_ROWS; other++) {
        codes = max(codes, codes_of(column, u32(clamp(i32(row) + other, 0, i32(EXTENT.y) - 1))));
    }
    return codes;
}

@compute @workgroup_size(THREADS)
fn bound_rays(@builtin(local_invocation_index) thread: u32, @builtin(workgroup_id) workgroup_id: vec3u) {
    let row = workgroup_id.y;
    let each = (EXTENT.x + THREADS - 1u) / THREADS;
    let first = min(thread * each, EXTENT.x);
    let end = min(first + each, EXTENT.x);
    var own = vec2u(0u);
    for (var column = first; column < end; column++) {
        own = max(own, codes_about(column, row));
    }
    maxima[thread] = own;
    workgroupBarrier();
    for (var step = 1u; step < THREADS; step *= 2u) {
        let other = maxima[min(thread + step, THREADS - 1u)];
        workgroupBarrier();
        maxima[thread] = max(maxima[thread], other);
        workgroupBarrier();
    }
    var passing = vec2u(0u);
    if thread + 1u < THREADS {
        passing = maxima[thread + 1u];
    }
    for (var column = end; column > first; column--) {
        let texel = column - 1u;
        passing = max(passing, codes_about(texel, row));
        // View rays are looked up between two columns.
        let ending = max(codes_of(texel, row), max(codes_of(max(texel, 1u) - 1u, row), codes_of(column, row)));
        textureStore(view_rays_map, vec2u(texel, row), vec4u(view_rays_texel(parameters.frame, passing, ending), 0u, 0u));
    }
}
