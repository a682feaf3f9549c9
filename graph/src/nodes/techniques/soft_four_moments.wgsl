import moment_shadows::moment_soft_shadows::{moment_soft_shadows_intensity};
import moment_shadows::specialization::{TABLE_ERROR};
import moment_shadows::summed_area_encoding::{summed_area_encoding_moment_bias};
import moment_shadows::technique_map::{table_sums};
import moment_shadows::technique_receiver::{TechniqueReceiver};
import moment_shadows::technique_soft::{soft_receiver, soft_table};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    return moment_soft_shadows_intensity(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);
}
