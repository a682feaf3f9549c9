
struct Sources {
    @location(0) @blend_src(0) texel: vec4f,
    @location(0) @blend_src(1) opacity: vec4f,
}

@fragment
fn four_moments_and_opacity(point: Point) -> Sources {
    return Sources(translucent_casters_four_moments(depth_of(point), STORAGE), vec4f(opacity_of(point)));
}
