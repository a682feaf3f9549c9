import node::integrate_target::{row_thickness};
import node::planes::{Planes, planes_divide, planes_fma, planes_if, planes_load, planes_store, rectified_map};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column};

// Normalised prefix sums along rows, on a GPU: a workgroup per row, 8 texels per invocation, the sums of invocations by the
// scan of Hillis and Steele (1986). Sums are f32 and are rounded once, to the storage.

const THREADS = 64u;
const TEXELS = 8u;

var<workgroup> sums: array<Planes, THREADS>;
var<workgroup> weights: array<f32, THREADS>;

@compute @workgroup_size(THREADS)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let columns = textureDimensions(rectified_map).x;
    let row = workgroup_id.y;
    let thickness = row_thickness(row);
    let thread = local.x;
    var before = Planes();
    var weight_before = 0.0;
    for (var start = 0u; start < columns; start += THREADS * TEXELS) {
        let first = start + thread * TEXELS;
        var sum = Planes();
        var weight = 0.0;
        var prefixes: array<Planes, TEXELS>;
        var prefix_weights: array<f32, TEXELS>;
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            let of_column = scattering_weights_of_column(thickness, f32(column));
            sum = planes_fma(of_column, planes_load(min(column, columns - 1u), row), sum);
            weight += of_column;
            prefixes[index] = sum;
            prefix_weights[index] = weight;
        }
        sums[thread] = sum;
        weights[thread] = weight;
        workgroupBarrier();
        for (var step = 1u; step < THREADS; step *= 2u) {
            let other = max(thread, step) - step;
            let added = planes_if(sums[other], thread >= step);
            let added_weight = select(0.0, weights[other], thread >= step);
            workgroupBarrier();
            sums[thread] += added;
            weights[thread] += added_weight;
            workgroupBarrier();
        }
        let previous = max(thread, 1u) - 1u;
        let inner = before + planes_if(sums[previous], thread > 0u);
        let inner_weight = weight_before + select(0.0, weights[previous], thread > 0u);
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            if column < columns {
                // The first weight is 1.
                let mean = planes_divide(inner + prefixes[index], inner_weight + prefix_weights[index]);
                planes_store(column, row, mean);
            }
        }
        before += sums[THREADS - 1u];
        weight_before += weights[THREADS - 1u];
        workgroupBarrier();
    }
}
