import moment_shadows::air::scattering_weights::{scattering_weights_of_column};

// Sums along a row of texels, with the weights of the row.

struct RowSums {
    texels: vec4f,
    weight: f32,
}

fn row_sums_texel(texel: vec4f, column: f32, thickness: f32) -> RowSums {
    let weight = scattering_weights_of_column(thickness, column);
    return RowSums(weight * texel, weight);
}

fn row_sums_join(first: RowSums, second: RowSums) -> RowSums {
    return RowSums(first.texels + second.texels, first.weight + second.weight);
}

// The mean up to a column. The weight is at least 1, that of the first column.
fn row_sums_mean(sums: RowSums, place: vec2u, thickness: f32) -> vec4f {
    return sums.texels / sums.weight;
}
