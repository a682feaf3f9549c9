import node::fullscreen::{Interpolated};
import moment_shadows::map::translucent_casters::{translucent_casters_four_moments, translucent_casters_six_moments, translucent_casters_two_moments};
import node::storage::{STORAGE};

// What a fragment of a translucent caster takes in a host's pass, beside its own depth and opacity: here the place in the map stands for them.

@fragment
fn two_moments(input: Interpolated) -> @location(0) vec4f {
    return translucent_casters_two_moments(input.place.z, input.place.y, STORAGE);
}

@fragment
fn four_moments(input: Interpolated) -> @location(0) vec4f {
    return translucent_casters_four_moments(input.place.z, STORAGE);
}

struct Planes {
    @location(0) odd: vec4f,
    @location(1) even: vec4f,
}

@fragment
fn six_moments(input: Interpolated) -> Planes {
    let texels = translucent_casters_six_moments(input.place.z, input.place.y, STORAGE);
    return Planes(texels[0], texels[1]);
}
