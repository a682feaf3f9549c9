import moment_shadows::shade::moment_soft_shadows::{moment_soft_shadows_variance_intensity};
import node::specialization::{TABLE_ERROR};
import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_smallest_variance};
import node::technique_map::{table_sums};
import node::technique_receiver::{TechniqueReceiver};
import node::technique_soft::{soft_receiver, soft_table};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let variance = summed_area_encoding_smallest_variance(TABLE_ERROR);
    return moment_soft_shadows_variance_intensity(table_sums, soft_table(receiver), variance, soft_receiver(receiver), receiver.light);
}
