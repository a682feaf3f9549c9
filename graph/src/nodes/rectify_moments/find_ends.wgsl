import node::camera_depth::{camera_depth_pixel, camera_depth_size};
import node::rectify_parameters::{parameters};
import node::scattering_ray::{scattering_ray_of};
import node::specialization::{EXTENT, GROUP};
import moment_shadows::air::view_rays::{view_rays_codes, view_rays_column};

// The least and the largest depth of the view rays of each row that end after each column.

@group(GROUP) @binding(7) var<storage, read_write> view_ray_codes: array<atomic<u32>>;

@compute @workgroup_size(8, 8)
fn find_ends(@builtin(global_invocation_id) id: vec3u) {
    if any(vec2i(id.xy) >= camera_depth_size()) {
        return;
    }
    let ray = scattering_ray_of(parameters.frame, camera_depth_pixel(vec2i(id.xy)));
    let column = view_rays_column(ray.place.x, f32(EXTENT.x));
    let codes = view_rays_codes(ray.depth);
    // The two rows between which the pixel is looked up.
    let row = min(u32(ray.place.y * f32(EXTENT.y - 1u)), EXTENT.y - 2u);
    for (var next = 0u; next < 2u; next++) {
        let place = 2u * ((row + next) * EXTENT.x + column);
        atomicMax(&view_ray_codes[place], codes.x);
        atomicMax(&view_ray_codes[place + 1u], codes.y);
    }
}
