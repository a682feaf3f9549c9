import node::integrate_target::{parameters, rectified_map};
import node::specialization::{GROUP};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column, scattering_weights_tilt};
import moment_shadows::air::view_rays::{VIEW_RAYS_ROWS, view_rays_sine};

// Sums along a row of texels, with the weights of the view rays that end where the sums do.

@group(GROUP) @binding(3) var view_rays_map: texture_2d<u32>;

struct RowSums {
    texels: vec4f,
    // Times the columns' middles.
    by_column: vec4f,
    weight: f32,
    weight_by_column: f32,
}

fn row_sums_texel(texel: vec4f, column: f32, thickness: f32) -> RowSums {
    let weight = scattering_weights_of_column(thickness, column);
    let by_column = (column + 0.5) * weight;
    return RowSums(weight * texel, by_column * texel, weight, by_column);
}

fn row_sums_join(first: RowSums, second: RowSums) -> RowSums {
    return RowSums(
        first.texels + second.texels,
        first.by_column + second.by_column,
        first.weight + second.weight,
        first.weight_by_column + second.weight_by_column,
    );
}

// The sine of the view rays that end about a texel, and about those of the rows around: the nearer, the more they count. 0 where none
// does.
fn ending_sine(place: vec2u) -> f32 {
    let last = i32(textureDimensions(view_rays_map).y) - 1;
    var sum = 0.0;
    var weights = 0.0;
    for (var other = -VIEW_RAYS_ROWS; other <= VIEW_RAYS_ROWS; other++) {
        let row = clamp(i32(place.y) + other, 0, last);
        let sine = view_rays_sine(textureLoad(view_rays_map, vec2i(i32(place.x), row), 0).xy);
        let weight = select(0.0, f32(VIEW_RAYS_ROWS + 1 - abs(other)), sine > 0.0);
        sum += weight * sine;
        weights += weight;
    }
    return sum / max(weights, 1.0);
}

// The mean up to a column. Its middle is before the view rays' end, so that the divisor is positive.
fn row_sums_mean(sums: RowSums, place: vec2u, thickness: f32) -> vec4f {
    let sine = ending_sine(place);
    let columns = f32(textureDimensions(rectified_map).x);
    let tilt = scattering_weights_tilt(parameters.frame, parameters.extinction, thickness, sine, f32(place.x), columns);
    let start = 0.5 * tilt + 1.0;
    let falls = tilt / (f32(place.x) + 1.5);
    return (start * sums.texels - falls * sums.by_column) / (start * sums.weight - falls * sums.weight_by_column);
}
