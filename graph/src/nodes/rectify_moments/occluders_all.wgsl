import moment_shadows::air::single_scattering::{single_scattering_occluder_depth};

// Any view ray of the frustum may pass any texel.

fn occluders_of(place: vec2u, depths: vec2f) -> vec2f {
    return vec2f(single_scattering_occluder_depth(depths.x), single_scattering_occluder_depth(depths.y));
}
