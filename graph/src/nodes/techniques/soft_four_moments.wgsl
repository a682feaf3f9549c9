import moment_shadows::shade::moment_soft_shadows::{moment_soft_shadows_intensity};
import node::specialization::{TABLE_ERROR};
import moment_shadows::filter::summed_area_encoding::{summed_area_encoding_moment_bias};
import node::technique_map::{table_sums};
import node::technique_receiver::{TechniqueReceiver};
import node::technique_soft::{soft_receiver, soft_table};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    return moment_soft_shadows_intensity(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);
}
