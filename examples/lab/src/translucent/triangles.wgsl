
// Triangles of a scene, as a light sees them.

@group(0) @binding(0) var image: texture_2d<f32>;
@group(0) @binding(1) var image_sampler: sampler;
// Stored depth of what is opaque.
@group(0) @binding(2) var opaque_depth: texture_2d<f32>;

struct Point {
    @builtin(position) position: vec4f,
    @location(0) uv: vec2f,
    @location(1) alpha: f32,
    @location(2) depth: f32,
}

// x and y of the map from -1 to 1, and moment depth; the alpha of material and vertex.
@vertex
fn place(@location(0) place: vec3f, @location(1) uv: vec2f, @location(2) alpha: f32) -> Point {
    return Point(vec4f(place.xy, 0.5, 1.0), uv, alpha, place.z);
}

fn depth_of(point: Point) -> f32 {
    return point.depth;
}

// Nothing behind what is opaque.
fn opacity_of(point: Point) -> f32 {
    let of_image = textureSampleLevel(image, image_sampler, point.uv, 0.0).a;
    let opaque = 2.0 * textureLoad(opaque_depth, vec2i(point.position.xy), 0).x - 1.0;
    return select(0.0, saturate(point.alpha * of_image), point.depth < opaque);
}
