//! Shadow intensity in vectors against other algorithms: exact bounds of rational moments, and double precision.

use std::f64::consts::PI;

use moment_shadows::{EsmFiltering, MapEncoding, Storage, Technique};
use moment_shadows_lab::oracle::{hamburger, hausdorff, rational, sensitivity, tolerance_unit};
use moment_shadows_lab::ports::{encodings, name, vectors};
use moment_shadows_lab::vectors::HARD_TOLERANCE;

/// What a row should give, and how far an f32 solver of moment problems may be off; of other techniques the vectors say so.
type Truth = (f64, Option<f64>);

#[test]
fn intensities_are_those_of_other_algorithms() {
    for encoding in encodings() {
        let vectors = vectors(&encoding).unwrap();
        let function = vectors
            .functions
            .iter()
            .find(|it| it.name == "technique_shadow_intensity");
        let rows = &function.unwrap().rows;
        assert!(rows.len() > 100);
        let mut darkest = 0.0_f64;
        for row in rows {
            let words: Vec<f64> = row
                .inputs
                .iter()
                .map(|it| f64::from(f32::from_bits(it.0)))
                .collect();
            let (depth, values) = words.split_last().unwrap();
            let (truth, tolerance) = truth(&encoding, values, depth.clamp(-1.0, 1.0));
            let found = f64::from(f32::from_bits(row.bits[0].0));
            let of_row = f64::from(row.tolerance[0]) + 1e-6;
            let allowed = tolerance.unwrap_or(of_row);
            assert!(
                (found - truth).abs() <= allowed,
                "{}: {found} is not {truth} within {allowed} at {depth} for {values:?}",
                name(&encoding)
            );
            darkest = darkest.max(truth);
        }
        assert!(darkest > 0.9, "{}", name(&encoding));
    }
}

fn truth(encoding: &MapEncoding, values: &[f64], z: f64) -> Truth {
    let storage = encoding.storage();
    match encoding.technique() {
        Technique::Vsm => {
            let pair = two(&values[..2], storage);
            (chebyshev(pair, z, smallest_variance(storage)), None)
        }
        Technique::Hamburger4 => {
            let bias = storage.moment_bias();
            let target = [0.0, bias.second, 0.0, bias.fourth];
            extremal(&four(values, storage), &target, bias.alpha, z, false)
        }
        Technique::Hausdorff4 => {
            let bias = storage.hausdorff_moment_bias();
            let target = [0.0, bias.second, 0.0, bias.fourth];
            extremal(&four(values, storage), &target, bias.alpha, z, true)
        }
        Technique::Hamburger6 => {
            let bias = storage.six_moments_bias().unwrap();
            let [second, fourth, sixth] = bias.even;
            let target = [0.0, second, 0.0, fourth, 0.0, sixth];
            extremal(&six(values, storage), &target, bias.alpha, z, false)
        }
        Technique::Esm {
            exponent,
            filtering,
        } => {
            let c = f64::from(exponent.unwrap().get());
            let is_scaled = *filtering == EsmFiltering::Linear && storage == Storage::Unorm16;
            let mean = values[0] * if is_scaled { c.exp() } else { 1.0 };
            ((1.0 - mean * (-c * z).exp()).clamp(0.0, 1.0), None)
        }
        Technique::Evsm2 { exponent } => {
            let c = f64::from(exponent.unwrap().get());
            (warped(&values[..2], (c * z).exp(), storage), None)
        }
        Technique::Evsm4 { positive, negative } => {
            let [p, n] = [positive, negative].map(|it| f64::from(it.unwrap().get()));
            let near = warped(&values[..2], (p * z).exp(), storage);
            (
                near.max(warped(&values[2..], -(-n * z).exp(), storage)),
                None,
            )
        }
        Technique::Lvsm { .. } => (layered(values, z, storage), None),
        Technique::Convolution { lower_bound, .. } => {
            (series(values, z, storage, *lower_bound), None)
        }
        other => panic!("{other} has no map"),
    }
}

/// The sharp lower bound for moments that are moved by `alpha` towards a target.
fn extremal(moments: &[f64], target: &[f32], alpha: f32, z: f64, on_interval: bool) -> Truth {
    let alpha = f64::from(alpha);
    let biased = moments
        .iter()
        .zip(target)
        .map(|(b, target)| b + alpha * (f64::from(*target) - b));
    let biased: Vec<_> = biased.map(|b| rational(b).unwrap()).collect();
    let depth = rational(z).unwrap();
    let [near, far] = [-1.0, 1.0].map(|end| rational(end).unwrap());
    let extremal = match on_interval {
        true => hausdorff(&biased, [&near, &far], &depth).unwrap(),
        false => hamburger(&biased, &depth).unwrap(),
    };
    let factor = match moments.len() {
        4 => 1.0,
        _ if alpha >= 5e-5 => 4.0,
        _ => 16.0,
    };
    let [lower, _] = sensitivity(&biased, &depth, &extremal).unwrap();
    (
        extremal.lower,
        Some(HARD_TOLERANCE * factor * tolerance_unit(lower)),
    )
}

/// What is added to the channels of a storage.
fn middle(storage: Storage) -> f64 {
    if storage == Storage::Float16 {
        0.5
    } else {
        0.0
    }
}

/// The solution of three equations, by Cramer's rule.
fn solve(rows: [[f64; 3]; 3], right: [f64; 3]) -> [f64; 3] {
    let determinant = |m: [[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1])
            - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    [0, 1, 2].map(|column| {
        let mut replaced = rows;
        for (row, value) in replaced.iter_mut().zip(right) {
            row[column] = value;
        }
        determinant(replaced) / determinant(rows)
    })
}

/// Four moments from the published basis (JCGT 6(1) 2017, equation 5).
fn four(values: &[f64], storage: Storage) -> Vec<f64> {
    // What a filter averages of packed texels are moments.
    if storage == Storage::Float32 || storage.is_packed() {
        return values.to_vec();
    }
    let channel = |index: usize| values[index] + middle(storage);
    let root = 3.0_f64.sqrt();
    let odd = [
        [1.5, -2.0, 0.0],
        [root / 2.0, -2.0 / 9.0 * root, 0.0],
        [0.0, 0.0, 1.0],
    ];
    let [b1, b3, _] = solve(odd, [channel(0) - 0.5, channel(2) - 0.5, 0.0]);
    let even = [[4.0, -4.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.0, 1.0]];
    let [b2, b4, _] = solve(even, [channel(1), channel(3), 0.0]);
    vec![b1, b2, b3, b4]
}

/// Six moments from the published basis (Muenstermann et al., i3D 2018).
fn six(values: &[f64], storage: Storage) -> Vec<f64> {
    let centre = match storage {
        Storage::Float16 | Storage::Float32 => 0.5,
        _ => 0.0,
    };
    let channels = |plane: usize| [0, 1, 2].map(|index| values[4 * plane + index] + centre);
    let [first, second] = [channels(0), channels(1)];
    let odd = [
        [2.5, -10.0, 8.0],
        [-1.8749986445, 4.20757543111, -1.83257678661],
        [1.26583039016, -1.47644882902, 0.71061660238],
    ];
    let even = [
        [4.0, -4.0, 0.0],
        [9.0, -24.0, 16.0],
        [-0.57759806484, 4.61936647543, -3.07953906655],
    ];
    let odd = solve(odd, first.map(|channel| channel - 0.5));
    let even = solve(even, [second[0], second[1], second[2] - 0.018888946]);
    odd.into_iter()
        .zip(even)
        .flat_map(|(odd, even)| [odd, even])
        .collect()
}

/// A mean and a mean square.
fn two(pair: &[f64], storage: Storage) -> [f64; 2] {
    match storage {
        Storage::Float32 => [pair[0], pair[1]],
        _ => {
            let [r, g] = [pair[0] + middle(storage), pair[1] + middle(storage)];
            [2.0 * r - 1.0, 1.0 - g]
        }
    }
}

fn smallest_variance(storage: Storage) -> f64 {
    match storage {
        Storage::Unorm16 => 6e-5,
        Storage::Float16 => 1e-3,
        _ => 5e-7,
    }
}

/// Cantelli's inequality.
fn chebyshev([mean, square]: [f64; 2], z: f64, smallest: f64) -> f64 {
    let variance = (square - mean * mean).max(smallest);
    let distance = z - mean;
    if distance <= 0.0 {
        0.0
    } else {
        1.0 / (1.0 + variance / (distance * distance))
    }
}

fn warped(pair: &[f64], warp: f64, storage: Storage) -> f64 {
    let [share, least] = match storage {
        Storage::Float16 => [2.2e-3, 9e-8],
        _ => [6e-7, 1e-37],
    };
    chebyshev([pair[0], pair[1]], warp, share * pair[1] + least)
}

/// Four layers of equal depth with an overlap of 0.02.
fn layered(values: &[f64], z: f64, storage: Storage) -> f64 {
    const OVERLAP: f64 = 0.02;
    let ends = [-1.0, -0.5, 0.0, 0.5, 1.0];
    let bound = |layer: usize| {
        let front = f64::max(ends[layer] - if layer > 0 { OVERLAP } else { 0.0 }, -1.0);
        let back = f64::min(ends[layer + 1] + if layer < 3 { OVERLAP } else { 0.0 }, 1.0);
        let place = ((2.0 * z - front - back) / (back - front)).clamp(-1.0, 1.0);
        chebyshev(
            two(&values[2 * layer..], storage),
            place,
            smallest_variance(storage),
        )
    };
    (0..4).map(bound).fold(0.0, f64::max)
}

/// The damped Fourier series of eight terms.
fn series(values: &[f64], z: f64, storage: Storage, lower_bound: bool) -> f64 {
    const SHIFT: f64 = 0.0596;
    const OVERSHOOT: f64 = 0.0231;
    let place = 0.5 * (z + 1.0) * (1.0 - 2.0 * SHIFT) - if lower_bound { SHIFT } else { 0.0 };
    let mut sum = 0.5 - if lower_bound { OVERSHOOT } else { 0.0 };
    for k in 1..=8 {
        let channel = |index: usize| match storage {
            Storage::Float16 => values[2 * (k - 1) + index],
            _ => 2.0 * values[2 * (k - 1) + index] - 1.0,
        };
        let c = PI * (2 * k - 1) as f64;
        let damping = (-(k as f64 / 8.0).powi(2)).exp();
        sum +=
            2.0 * damping / c * ((c * place).sin() * channel(1) - (c * place).cos() * channel(0));
    }
    sum.clamp(0.0, 1.0)
}
