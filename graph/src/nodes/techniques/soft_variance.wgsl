import moment_shadows::moment_soft_shadows::{moment_soft_shadows_variance_intensity};
import moment_shadows::specialization::{TABLE_ERROR};
import moment_shadows::summed_area_encoding::{summed_area_encoding_smallest_variance};
import moment_shadows::technique_map::{table_sums};
import moment_shadows::technique_receiver::{TechniqueReceiver};
import moment_shadows::technique_soft::{soft_receiver, soft_table};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let variance = summed_area_encoding_smallest_variance(TABLE_ERROR);
    return moment_soft_shadows_variance_intensity(table_sums, soft_table(receiver), variance, soft_receiver(receiver), receiver.light);
}
