import moment_shadows::map::translucent_casters::{translucent_casters_four_moments, translucent_casters_six_moments, translucent_casters_two_moments};
import node::storage::{STORAGE};

// A caster's fragments for maps of every technique. What follows says where they are and what they are of: struct Point, depth_of and
// opacity_of.

@fragment
fn two_moments(point: Point) -> @location(0) vec4f {
    return translucent_casters_two_moments(depth_of(point), opacity_of(point), STORAGE);
}

@fragment
fn four_moments(point: Point) -> @location(0) vec4f {
    return translucent_casters_four_moments(depth_of(point), STORAGE);
}

@fragment
fn four_moments_product(point: Point) -> @location(0) vec4f {
    return vec4f(opacity_of(point));
}

@fragment
fn four_moments_sum(point: Point) -> @location(0) vec4f {
    return opacity_of(point) * translucent_casters_four_moments(depth_of(point), STORAGE);
}

struct Planes {
    @location(0) odd: vec4f,
    @location(1) even: vec4f,
}

@fragment
fn six_moments(point: Point) -> Planes {
    let texels = translucent_casters_six_moments(depth_of(point), opacity_of(point), STORAGE);
    return Planes(texels[0], texels[1]);
}
