//! The strata that inputs are drawn from.

use core::ops::Range;

use moment_shadows::{DepthConversion, DepthRange};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::input::Input;
use super::{gauss_node, invalid, kernels};

/// A regime of inputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stratum {
    /// One to eight surfaces anywhere.
    Diracs,
    /// Surfaces 1e-1 down to 1e-9 apart, and the fragment among them.
    NearCoincident,
    /// Surfaces at both ends of the light's range.
    Ends,
    /// A slope: surfaces at equal distances.
    Slope,
    /// Depth as a map stores it, over 1e-3 to 1e6 scene units.
    DepthRange,
    /// A fragment exactly at a surface.
    AtSurface,
    /// A fragment at a Gauss node of four biased moments, or a few units in the last place beside it.
    AtGaussNode,
    /// A fragment at a Gauss node of six biased moments, or a few units in the last place beside it.
    AtGaussNodeOfSix,
    /// A resolve and a two-pass blur, 3 to 9 texels wide.
    Filtered,
    /// A resolve and a two-pass blur, 17 to 129 texels wide.
    FilteredWide,
    /// Texels of random bits, of moments that rounding made impossible, of negative variance.
    InvalidTexel,
    /// Subnormal numbers, infinities and NaN as depths and fragments.
    NotFinite,
}

impl Stratum {
    /// All strata, each of which gets an equal share of the inputs.
    pub const ALL: [Stratum; 12] = [
        Stratum::Diracs,
        Stratum::NearCoincident,
        Stratum::Ends,
        Stratum::Slope,
        Stratum::DepthRange,
        Stratum::AtSurface,
        Stratum::AtGaussNode,
        Stratum::AtGaussNodeOfSix,
        Stratum::Filtered,
        Stratum::FilteredWide,
        Stratum::InvalidTexel,
        Stratum::NotFinite,
    ];

    /// The name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Stratum::Diracs => "Diracs",
            Stratum::NearCoincident => "near-coincident",
            Stratum::Ends => "ends",
            Stratum::Slope => "slope",
            Stratum::DepthRange => "depth range",
            Stratum::AtSurface => "at a surface",
            Stratum::AtGaussNode => "at a Gauss node",
            Stratum::AtGaussNodeOfSix => "at a Gauss node of six",
            Stratum::Filtered => "filtered",
            Stratum::FilteredWide => "filtered widely",
            Stratum::InvalidTexel => "invalid texel",
            Stratum::NotFinite => "not finite",
        }
    }

    /// An input of the stratum.
    pub fn sample(self, random: &mut ChaCha8Rng) -> Input {
        match self {
            Stratum::Diracs => diracs(random),
            Stratum::NearCoincident => near_coincident(random),
            Stratum::Ends => ends(random),
            Stratum::Slope => slope(random),
            Stratum::DepthRange => depth_range(random),
            Stratum::AtSurface => at_surface(random),
            Stratum::AtGaussNode => gauss_node::of_four_moments(diracs(random), random),
            Stratum::AtGaussNodeOfSix => gauss_node::of_six_moments(diracs(random), random),
            Stratum::Filtered => filtered(random, 0..kernels::NARROW),
            Stratum::FilteredWide => filtered(random, kernels::NARROW..kernels::COUNT),
            Stratum::InvalidTexel => invalid::texel(random),
            Stratum::NotFinite => invalid::not_finite(random),
        }
    }
}

/// 10 to a random power.
fn magnitude(random: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    10.0_f64.powf(random.random_range(from..to))
}

pub(super) fn signed_magnitude(random: &mut ChaCha8Rng, from: f64, to: f64) -> f64 {
    let sign = if random.random() { 1.0 } else { -1.0 };
    sign * magnitude(random, from, to)
}

/// Weights that sum to 1 but for a rounding, which is in the largest: a greater error would be one of the moments.
pub(super) fn normalise(weights: &mut [f32]) {
    let total: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    for weight in &mut *weights {
        *weight = (f64::from(*weight) / total) as f32;
    }
    let sum: f64 = weights.iter().map(|&weight| f64::from(weight)).sum();
    if let Some(largest) = weights.iter_mut().max_by(|a, b| a.total_cmp(b)) {
        *largest = (f64::from(*largest) + 1.0 - sum) as f32;
    }
}

/// Surfaces of the given depths, alike or with random weights, some of them slight, and a fragment anywhere.
fn mixture(random: &mut ChaCha8Rng, depths: &[f64]) -> Input {
    let mut input = Input {
        count: depths.len() as u32,
        ..Input::default()
    };
    let alike = random.random_range(0..4) == 0;
    for (index, &depth) in depths.iter().enumerate() {
        input.depths[index] = depth.clamp(-1.0, 1.0) as f32;
        input.weights[index] = if alike {
            1.0
        } else if random.random() {
            random.random_range(0.01..1.0)
        } else {
            magnitude(random, -7.0, 0.0) as f32
        };
    }
    normalise(&mut input.weights);
    input.fragment_depth = fragment(random, depths);
    input
}

/// Anywhere, or a little beside a surface.
fn fragment(random: &mut ChaCha8Rng, depths: &[f64]) -> f32 {
    let anywhere = random.random_range(-1.0..=1.0);
    let depth = if random.random() {
        depths[random.random_range(0..depths.len())] + signed_magnitude(random, -9.0, 0.0)
    } else {
        anywhere
    };
    depth.clamp(-1.0, 1.0) as f32
}

fn anywhere(random: &mut ChaCha8Rng) -> Vec<f64> {
    let count = random.random_range(1..=8);
    (0..count)
        .map(|_| random.random_range(-1.0..=1.0))
        .collect()
}

fn around(random: &mut ChaCha8Rng) -> Vec<f64> {
    let gap = magnitude(random, -9.0, -1.0);
    // Around 0, where f32 can tell 1e-9 apart, or anywhere.
    let base = if random.random() {
        0.0
    } else {
        random.random_range(-1.0..=1.0)
    };
    let count = random.random_range(2..=8);
    (0..count)
        .map(|_| base + gap * random.random_range(-1.0..=1.0))
        .collect()
}

fn at_ends(random: &mut ChaCha8Rng) -> Vec<f64> {
    let count = random.random_range(1..=8);
    (0..count)
        .map(|_| match random.random_range(0..5) {
            0 | 1 => -1.0,
            2 | 3 => 1.0,
            _ => random.random_range(-1.0..=1.0),
        })
        .collect()
}

fn sloped(random: &mut ChaCha8Rng) -> Vec<f64> {
    let first = random.random_range(-1.0..=1.0);
    let step = signed_magnitude(random, -6.0, -0.5);
    (0..8)
        .map(|index| first + f64::from(index) * step)
        .collect()
}

pub(super) fn diracs(random: &mut ChaCha8Rng) -> Input {
    let depths = anywhere(random);
    mixture(random, &depths)
}

fn near_coincident(random: &mut ChaCha8Rng) -> Input {
    let depths = around(random);
    mixture(random, &depths)
}

fn ends(random: &mut ChaCha8Rng) -> Input {
    let depths = at_ends(random);
    let mut input = mixture(random, &depths);
    if random.random_range(0..3) == 0 {
        input.fragment_depth = [-1.0, 1.0, 1.0_f32.next_down()][random.random_range(0..3)];
    }
    input
}

fn slope(random: &mut ChaCha8Rng) -> Input {
    let depths = sloped(random);
    mixture(random, &depths)
}

fn at_surface(random: &mut ChaCha8Rng) -> Input {
    let depths = if random.random() {
        anywhere(random)
    } else {
        around(random)
    };
    let mut input = mixture(random, &depths);
    input.fragment_depth = input.depths[random.random_range(0..depths.len())];
    input
}

fn filtered(random: &mut ChaCha8Rng, range: Range<u32>) -> Input {
    let depths = match random.random_range(0..4) {
        0 => anywhere(random),
        1 => around(random),
        2 => at_ends(random),
        _ => sloped(random),
    };
    let mut input = mixture(random, &depths);
    input.kind = Input::PATCH;
    input.weights = [0.0; 8];
    input.kernel = random.random_range(range);
    input.coverage = random.random_range(0..4_u32) * u32::from(random.random_range(0..2_u32) == 0);
    input.rows = [random.random(), random.random()];
    input.column = random.random();
    // Noise, edges, and all alike.
    let mut run = || [1, 3, 16, 48, 129][random.random_range(0..5)];
    [input.row_run, input.column_run] = [run(), run()];
    if random.random_range(0..4) == 0 {
        input.fragment_depth = input.depths[0];
    }
    input
}

/// A light's convention over a range of scene units, and depths as its map stores them.
fn depth_range(random: &mut ChaCha8Rng) -> Input {
    let extent = magnitude(random, -3.0, 6.0);
    let mut input = diracs(random);
    let ratio = magnitude(random, -4.0, 0.0);
    let near = if random.random() {
        ratio * extent
    } else {
        extent
    };
    let range = DepthRange {
        near,
        far: near + extent,
    };
    let infinite = random.random();
    let far = if infinite { f64::INFINITY } else { range.far };
    // Positive ranges and planes are valid; none would be a mistake of this file and leave parallel light.
    let kind = random.random_range(0..5);
    let conversion = match kind {
        0 => DepthConversion::linear(range).ok(),
        1 => DepthConversion::perspective(near, far, range).ok(),
        2 => DepthConversion::perspective(near, far, range)
            .map(DepthConversion::reversed)
            .ok(),
        3 => Some(DepthConversion::orthographic().reversed()),
        _ => Some(DepthConversion::orthographic()),
    };
    let stored = |moment_depth: f32| -> f32 {
        let share = 0.5 * f64::from(moment_depth) + 0.5;
        let distance = near + extent * share;
        let closeness = near / distance;
        let end = if infinite { 0.0 } else { near / far };
        let stored = match kind {
            0 => distance,
            1 => (1.0 - closeness) / (1.0 - end),
            2 => (closeness - end) / (1.0 - end),
            3 => 1.0 - share,
            _ => share,
        };
        stored as f32
    };
    input.depths = input.depths.map(stored);
    input.fragment_depth = stored(input.fragment_depth);
    input.conversion = conversion.unwrap_or_else(DepthConversion::orthographic);
    input.converted = 1;
    input
}

#[cfg(test)]
mod tests {
    use rand::SeedableRng;

    use super::super::truth::truth;
    use super::*;

    #[test]
    fn mixtures_have_weights_that_sum_to_one_and_depths_in_range() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        for stratum in Stratum::ALL {
            for _ in 0..2000 {
                let input = stratum.sample(&mut random);
                if input.kind == Input::MIXTURE {
                    let sum: f64 = input.weights.iter().map(|&weight| f64::from(weight)).sum();
                    assert!((sum - 1.0).abs() <= 6e-8, "{stratum:?}: {input:?}");
                }
                if input.kind != Input::TEXEL && input.converted == 0 {
                    let all = input.depths.iter();
                    assert!(all.into_iter().all(|depth| depth.abs() <= 1.0), "{input:?}");
                }
            }
        }
    }

    #[test]
    fn most_strata_have_truths_of_every_kind() {
        let kernels = super::super::kernels::kernels().unwrap_or_default();
        let mut random = ChaCha8Rng::seed_from_u64(2);
        for stratum in Stratum::ALL {
            let truths: Vec<f64> = (0..2000)
                .filter_map(|_| truth(&stratum.sample(&mut random), &kernels))
                .collect();
            if stratum == Stratum::InvalidTexel {
                assert!(truths.is_empty());
                continue;
            }
            let count = |range: core::ops::RangeInclusive<f64>| {
                truths.iter().filter(|truth| range.contains(truth)).count()
            };
            let counts = [count(0.0..=0.0), count(0.01..=0.99), count(0.999..=1.0)];
            assert!(
                counts.iter().all(|&count| count > 50),
                "{stratum:?}: {counts:?}"
            );
        }
    }
}
