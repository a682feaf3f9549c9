import node::occluders_shares::{Occluders};
import moment_shadows::air::single_scattering::{single_scattering_occluder_depth};

// Any view ray of the frustum may pass any texel.

fn shares_of(depth: f32) -> vec2f {
    return select(vec2f(0.0), vec2f(1.0), vec2<bool>(depth <= -1.0, depth > -1.0 && depth < 1.0));
}

fn occluders_of(place: vec2u, depths: vec2f) -> Occluders {
    let moved = vec2f(single_scattering_occluder_depth(depths.x), single_scattering_occluder_depth(depths.y));
    return Occluders(moved, array<vec2f, 2>(shares_of(moved.x), shares_of(moved.y)));
}
