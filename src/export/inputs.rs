//! What exported functions are called with in vectors.

/// The words of a value of numbers.
pub(super) fn words(numbers: impl IntoIterator<Item = f32>) -> Vec<u32> {
    numbers.into_iter().map(f32::to_bits).collect()
}

/// Depths to encode: the ends, the middle, and places in between that no storage holds exactly.
pub(super) fn depths() -> Vec<f32> {
    let between = (0..24).map(|index| ((index as f32 * 0.618_034).fract()) * 2.0 - 1.0);
    [-1.0, 1.0, 0.0, -0.5, 0.25, 1e-4, -1e-7]
        .into_iter()
        .chain(between)
        .collect()
}

/// Fragments from before everything to behind it, and beyond both ends.
pub(super) fn fragment_depths(index: usize) -> Vec<f32> {
    let places = [
        -1.5, -0.95, -0.6, -0.3, -0.1, 0.05, 0.2, 0.35, 0.5, 0.65, 0.8, 0.95, 1.0, 1.5,
    ];
    let shift = 0.007 * index as f32;
    places.iter().map(|place| place + shift).collect()
}

/// The mean of two values.
pub(super) fn average(a: &[u32], b: &[u32]) -> Vec<u32> {
    let pairs = a.iter().zip(b);
    let mean = |(a, b): (&u32, &u32)| 0.5 * f32::from_bits(*a) + 0.5 * f32::from_bits(*b);
    words(pairs.map(mean))
}

/// Depths under a filter: one surface, an edge, an edge with more texels on one side, three surfaces, a slope.
pub(super) fn mixtures() -> Vec<Vec<f32>> {
    vec![
        vec![0.1],
        vec![-0.7],
        vec![-0.4, 0.3],
        vec![-0.8, 0.6, 0.6, 0.6],
        vec![-0.2, -0.2, -0.2, 0.9],
        vec![-0.5, 0.1, 0.7],
        vec![-0.9, -0.3, 0.2, 0.8],
        vec![0.3, 0.31, 0.32, 0.33, 0.34, 0.35, 0.36],
    ]
}

/// Stored depths with conversions of parallel rays, and of a perspective from 0.5 to 100 in forward and reversed depth.
pub(super) fn conversions() -> Vec<Vec<u32>> {
    let perspective = [[-1.0, 0.995], [1.0, 0.005]];
    let conversions = [
        ([[-1.0, 1.0], [1.0, 1.0]], [1.0, 0.0]),
        (perspective, [1.0, 0.0]),
        (perspective, [-1.0, 1.0]),
    ];
    let mut all = Vec::new();
    for ([numerator, denominator], factor) in conversions {
        for stored in [
            0.0,
            1e-3,
            0.25,
            0.5,
            0.75,
            0.99,
            1.0,
            1.25,
            -0.5,
            f32::NAN,
            f32::INFINITY,
        ] {
            let conversion = [numerator, denominator, factor, [0.0; 2]].concat();
            all.push([words([stored]), words(conversion)].concat());
        }
    }
    all
}

/// Intensities with each of the reductions, and with all.
pub(super) fn reductions() -> Vec<Vec<u32>> {
    let mut all = Vec::new();
    for reduction in [
        [1.0, 0.0, 1.0],
        [0.98, 0.0, 1.0],
        [1.0, 0.2, 1.0],
        [1.0, 0.0, 2.0],
        [0.95, 0.1, 1.5],
    ] {
        for intensity in [0.0, 0.1, 0.35, 0.6, 0.85, 0.97, 1.0] {
            all.push(words([intensity].into_iter().chain(reduction).chain([0.0])));
        }
    }
    all
}
