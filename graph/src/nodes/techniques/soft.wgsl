import moment_shadows::shade::moment_soft_shadows::{MomentSoftShadowReceiver, MomentSoftShadowTable};
import node::specialization::{FILTER_INTERPOLATED, LARGEST_KERNEL, SEARCH_INTERPOLATED, TABLE_UNIT};
import node::technique_receiver::{TechniqueReceiver};

// A receiver of a view as soft shadows take it, and the table.

fn soft_table(receiver: TechniqueReceiver) -> MomentSoftShadowTable {
    return MomentSoftShadowTable(receiver.layer, receiver.region, LARGEST_KERNEL, TABLE_UNIT, SEARCH_INTERPOLATED, FILTER_INTERPOLATED);
}

fn soft_receiver(receiver: TechniqueReceiver) -> MomentSoftShadowReceiver {
    let place = vec2f(receiver.region.origin) + receiver.uv * vec2f(receiver.region.extent);
    let footprint = 0.5 * max(abs(receiver.difference_x), abs(receiver.difference_y));
    return MomentSoftShadowReceiver(place, footprint, receiver.depth, receiver.gradient, receiver.steepest);
}
