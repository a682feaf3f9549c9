import moment_shadows::map::depth::{depth_of_light};
import moment_shadows::techniques::percentage_closer_hardware::{percentage_closer_hardware_box};
import moment_shadows::shade::receiver_plane::{receiver_plane_through};
import node::specialization::{RADIUS};
import node::technique_map::{depth_map, comparison_sampler};
import node::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let plane = receiver_plane_through(receiver.uv, receiver.depth, receiver.gradient, receiver.steepest, depth_of_light(receiver.conversion));
    return percentage_closer_hardware_box(depth_map, comparison_sampler, receiver.layer, receiver.region, plane, receiver.conversion, RADIUS);
}
