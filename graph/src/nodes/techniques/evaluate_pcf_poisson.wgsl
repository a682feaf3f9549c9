import moment_shadows::depth::{depth_of_light};
import moment_shadows::disk_samples::{disk_samples_angle};
import moment_shadows::percentage_closer::{percentage_closer_poisson};
import moment_shadows::receiver_plane::{receiver_plane_through};
import moment_shadows::specialization::{DISK_RADIUS};
import moment_shadows::technique_map::{depth_map};
import moment_shadows::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, depth_of_light(receiver.conversion));
    return percentage_closer_poisson(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, DISK_RADIUS, disk_samples_angle(receiver.pixel));
}
