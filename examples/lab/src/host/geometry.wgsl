// Vertices of the scene, and what a view draws of them: depth alone, with holes where a material is masked, or the
// surface that a camera sees.

struct View {
    clip_from_world: mat4x4f,
    // World position of the eye.
    eye: vec3f,
}

struct Surface {
    // Linear, multiplied with the texture.
    base_colour: vec4f,
    // Alpha below this is a hole; negative where nothing is.
    mask: f32,
}

@group(0) @binding(0) var<uniform> view: View;
@group(1) @binding(0) var<uniform> surface: Surface;
@group(1) @binding(1) var base_colour_texture: texture_2d<f32>;
@group(1) @binding(2) var base_colour_sampler: sampler;

struct Vertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) uv: vec2f,
    @location(3) alpha: f32,
}

struct Point {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    // Per sample, so that a hole is seen by as many samples as one between triangles.
    @location(2) @interpolate(perspective, sample) uv: vec2f,
    @location(3) @interpolate(perspective, sample) alpha: f32,
}

@vertex
fn place(vertex: Vertex) -> Point {
    var point: Point;
    point.clip = view.clip_from_world * vec4f(vertex.position, 1.0);
    point.world = vertex.position;
    point.normal = vertex.normal;
    point.uv = vertex.uv;
    point.alpha = vertex.alpha;
    return point;
}

// The image is read at its full size, however small it is seen: mips hold means of alpha, in which all that is fine has
// vanished or is solid.
fn is_hole(point: Point) -> bool {
    let image = textureSampleLevel(base_colour_texture, base_colour_sampler, point.uv, 0.0);
    return surface.base_colour.a * point.alpha * image.a < surface.mask;
}

// Depth only, for masked materials.
@fragment
fn depth_masked(point: Point) {
    if is_hole(point) {
        discard;
    }
}

struct Pixel {
    // World position. w holds the shading normal: two coordinates of 12 bits as one whole number, plus 1; 0 is sky.
    @location(0) position: vec4f,
    // The triangle's own normal, on the side that is seen.
    @location(1) normal: vec4f,
    @location(2) base_colour: vec4f,
}

@fragment
fn seen(point: Point) -> Pixel {
    // Derivatives and samples come first: they need uniform control flow.
    let across = dpdx(point.world);
    let down = dpdy(point.world);
    let colour = surface.base_colour * textureSample(base_colour_texture, base_colour_sampler, point.uv);
    if is_hole(point) {
        discard;
    }
    let towards_eye = normalize(view.eye - point.world);
    // Lengths are scaled first: a small scene seen closely would square to a denormal number.
    let area = cross(scaled(across), scaled(down));
    var geometric = towards_eye;
    if dot(area, area) > 1e-12 {
        geometric = normalize(area);
    }
    if dot(geometric, towards_eye) < 0.0 {
        geometric = -geometric;
    }
    var shading = geometric;
    if dot(point.normal, point.normal) > 1e-6 {
        shading = normalize(point.normal);
        if dot(shading, geometric) < 0.0 {
            shading = -shading;
        }
    }
    var pixel: Pixel;
    pixel.position = vec4f(point.world, 1.0 + packed_direction(shading));
    pixel.normal = vec4f(geometric, 1.0);
    pixel.base_colour = vec4f(colour.rgb, 1.0);
    return pixel;
}

// A vector divided by its largest component.
fn scaled(v: vec3f) -> vec3f {
    let largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return v / max(largest, 1e-30);
}

// A unit vector as a whole number below 2^24, which f32 holds exactly: octahedral coordinates of 12 bits each.
fn packed_direction(direction: vec3f) -> f32 {
    let sum = abs(direction.x) + abs(direction.y) + abs(direction.z);
    var folded = direction.xy / sum;
    if direction.z < 0.0 {
        folded = (1.0 - abs(folded.yx)) * select(vec2f(-1.0), vec2f(1.0), folded >= vec2f(0.0));
    }
    let steps = floor(clamp(0.5 + 0.5 * folded, vec2f(0.0), vec2f(1.0)) * 4094.0 + 0.5);
    return steps.x * 4096.0 + steps.y;
}
