import node::integrate_target::{integrated_map, rectified_map, row_thickness};
import node::map_filtering::{filtering_texel};
import moment_shadows::air::scattering_weights::{scattering_weights_of_column};

// Normalised prefix sums along rows, on a GPU: a workgroup per row, 8 texels per invocation, the sums of invocations by the
// scan of Hillis and Steele (1986). Sums are f32 and are rounded once, to the storage.

const THREADS = 64u;
const TEXELS = 8u;

var<workgroup> sums: array<vec4f, THREADS>;
var<workgroup> weights: array<f32, THREADS>;

@compute @workgroup_size(THREADS)
fn integrate(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let columns = textureDimensions(rectified_map).x;
    let row = workgroup_id.y;
    let thickness = row_thickness(row);
    let thread = local.x;
    var before = vec4f(0.0);
    var weight_before = 0.0;
    for (var start = 0u; start < columns; start += THREADS * TEXELS) {
        let first = start + thread * TEXELS;
        var sum = vec4f(0.0);
        var weight = 0.0;
        var prefixes: array<vec4f, TEXELS>;
        var prefix_weights: array<f32, TEXELS>;
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            let of_column = scattering_weights_of_column(thickness, f32(column));
            let texel = textureLoad(rectified_map, vec2u(min(column, columns - 1u), row), 0);
            sum = fma(vec4f(of_column), texel, sum);
            weight += of_column;
            prefixes[index] = sum;
            prefix_weights[index] = weight;
        }
        sums[thread] = sum;
        weights[thread] = weight;
        workgroupBarrier();
        for (var step = 1u; step < THREADS; step *= 2u) {
            let other = max(thread, step) - step;
            let added = select(vec4f(0.0), sums[other], thread >= step);
            let added_weight = select(0.0, weights[other], thread >= step);
            workgroupBarrier();
            sums[thread] += added;
            weights[thread] += added_weight;
            workgroupBarrier();
        }
        let previous = max(thread, 1u) - 1u;
        let inner = before + select(vec4f(0.0), sums[previous], thread > 0u);
        let inner_weight = weight_before + select(0.0, weights[previous], thread > 0u);
        for (var index = 0u; index < TEXELS; index++) {
            let column = first + index;
            if column < columns {
                // The first weight is 1.
                let mean = (inner + prefixes[index]) / (inner_weight + prefix_weights[index]);
                textureStore(integrated_map, vec2u(column, row), filtering_texel(mean));
            }
        }
        before += sums[THREADS - 1u];
        weight_before += weights[THREADS - 1u];
        workgroupBarrier();
    }
}
