import node::occluders_shares::{Occluders};
import node::specialization::{GROUP};
import moment_shadows::air::view_rays::{VIEW_RAYS_ROWS, view_rays_shares};

// It is known which view rays pass a texel.

@group(GROUP) @binding(6) var view_rays_map: texture_2d<u32>;

fn occluders_of(place: vec2u, depths: vec2f) -> Occluders {
    let last = i32(textureDimensions(view_rays_map).y) - 1;
    var shares = array<vec2f, 2>();
    for (var other = -VIEW_RAYS_ROWS; other <= VIEW_RAYS_ROWS; other++) {
        let row = clamp(i32(place.y) + other, 0, last);
        let texel = textureLoad(view_rays_map, vec2i(i32(place.x), row), 0).xy;
        shares[0] += view_rays_shares(texel, depths.x);
        shares[1] += view_rays_shares(texel, depths.y);
    }
    const each = 1.0 / f32(2 * VIEW_RAYS_ROWS + 1);
    return Occluders(depths, array<vec2f, 2>(each * shares[0], each * shares[1]));
}
