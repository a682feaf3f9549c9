import super::super::air::single_scattering::{SINGLE_SCATTERING_DEPTH_BIAS};
import super::super::air::rectified_frame::{RectifiedFrame, rectified_frame_inclination};
import super::super::maths::angle::{angle_sin_cos};

// Which view rays a picture has, by texel of a rectified map: known from the camera's depth.
//
// A view ray passes the texels of its row up to where it ends. An occluder of a texel shadows the view rays that pass it deeper
// than itself: if all of them are deeper, its exact depth does not matter, and it counts as one in front of everything; if none is, it
// shadows nothing, and counts as none. Both leave the moments to the occluders between, and lit ground, behind which no view
// ray goes on, is no occluder at all. What is shown stays the same, but moments bound it more sharply.
//
// Sharper bounds are other bounds, and would flicker where one view ray more makes the difference. So each texel knows the view
// rays of `VIEW_RAYS_ROWS` rows to either side as well, and what counts as what is the mean over as many: true for the view rays of
// the row itself, as each of these knows them, it changes little by little while an edge of the picture passes from row to row.
//
// Depths here are the rectified ones in [-1, 1]; view rays of larger depth are nearer to the direction in which light travels.

// The last column that a view ray passes whole, of one that ends at a place from 0 to 1 across `columns` columns. A view ray that
// passes none counts in the first one.
fn view_rays_column(place: f32, columns: f32) -> u32 {
    return min(u32(max(fma(place, columns, -1.0), 0.0)), u32(columns) - 1u);
}

// Codes whose maxima over view rays, as whole numbers, are those of the least and the largest depth. That of no view ray is 0.
fn view_rays_codes(depth: f32) -> vec2u {
    return bitcast<vec2u>(vec2f(2.0 - depth, 2.0 + depth));
}

// The least and the largest depth of codes that are not 0. Whatever a code is, its depth is in [-1, 1].
fn view_rays_depths(codes: vec2u) -> vec2f {
    let sums = bitcast<vec2f>(clamp(codes, bitcast<vec2u>(vec2f(1.0)), bitcast<vec2u>(vec2f(3.0))));
    return vec2f(2.0 - sums.x, sums.y - 2.0);
}

// Rows to either side.
const VIEW_RAYS_ROWS: i32 = 4;

// The steps in which a texel holds depths.
const VIEW_RAYS_STEPS: f32 = 65535.0;

// The texel for the codes of the view rays that pass it, and of those that end about here. Bounds are rounded outwards.
fn view_rays_texel(frame: RectifiedFrame, passing: vec2u, ending: vec2u) -> vec2u {
    if any(passing == vec2u(0u)) {
        return vec2u(0xffff0000u, 0u);
    }
    let steps = VIEW_RAYS_STEPS * fma(view_rays_depths(passing), vec2f(0.5), vec2f(0.5));
    // A whole step to either side is more than f32 rounds.
    let low = u32(max(floor(steps.x) - 1.0, 0.0));
    let high = u32(min(ceil(steps.y) + 1.0, VIEW_RAYS_STEPS));
    if any(ending == vec2u(0u)) {
        return vec2u(low | (high << 16u), 0u);
    }
    let depths = view_rays_depths(ending);
    let first = angle_sin_cos(rectified_frame_inclination(frame, depths.x)).x;
    let last = angle_sin_cos(rectified_frame_inclination(frame, depths.y)).x;
    return vec2u(low | (high << 16u), bitcast<u32>(max(0.5 * (first + last), 1e-6)));
}

// What of an occluder counts as one in front of all view rays that pass its texel, and what as one at its depth. The rest, up to 1,
// counts as none: so does an occluder a little before the last of the view rays, as a lit surface is to those of the rows around.
fn view_rays_shares(texel: vec2u, depth: f32) -> vec2f {
    let step = VIEW_RAYS_STEPS * fma(depth, 0.5, 0.5);
    let before = step <= f32(texel.x & 0xffffu);
    let behind = step >= f32(texel.x >> 16u) - VIEW_RAYS_STEPS * SINGLE_SCATTERING_DEPTH_BIAS;
    return select(select(vec2f(0.0, 1.0), vec2f(1.0, 0.0), before), vec2f(0.0), behind);
}

// The sine of the inclination of view rays that end about a texel: the mean of the smallest and the largest. 0 where none does.
fn view_rays_sine(texel: vec2u) -> f32 {
    return bitcast<f32>(texel.y);
}
