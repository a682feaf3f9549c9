//! What techniques give for known surfaces in f64: without errors, or with the biases of a storage and nothing rounded.
//!
//! What the truth has more than the former is a technique's own error; what the latter lacks is that of its bias; what a shader adds
//! is rounding. Distances are taken from the fragment wherever moments would cancel.

mod moments;
mod series;
mod surfaces;

use moment_shadows::{LayerSplits, MapEncoding, Storage, Technique};
use series::FourierSeries;
use surfaces::Surfaces;

use crate::wgsl_number::numbers;

/// A technique without rounding.
#[derive(Clone, Debug, PartialEq)]
pub struct Ideal {
    bound: Bound,
    /// Depths and weights that a moment bias mixes in.
    added: Vec<[f64; 2]>,
}

#[derive(Clone, Debug, PartialEq)]
enum Bound {
    /// Markov's inequality for e^(c z).
    Exponential(f64),
    /// Cantelli's inequality for warped depth, the darkest of several warps: e^(c z), or -e^(c z) where c is below 0. The
    /// variance is at least x E[w^2] + y.
    Warped {
        exponents: Vec<f64>,
        smallest: [f64; 2],
    },
    /// Cantelli's inequality within layers of depth, of which the darkest counts.
    Layered {
        /// Where layers end, but for the last.
        splits: Vec<f64>,
        overlap: f64,
        smallest: f64,
    },
    Series(FourierSeries),
    /// Twice as many power moments, on the real line.
    Hamburger(usize),
    /// Four power moments on [-1, 1].
    Hausdorff,
}

impl Ideal {
    /// A technique without a bias, or with that of a `storage`. `None` where it reads the plain depth map, or where its layers are
    /// placed by what the map holds.
    #[must_use]
    pub fn of(technique: &Technique, storage: Option<Storage>) -> Option<Self> {
        let exponent = |given: &Option<moment_shadows::Finite>| {
            let given = given.map_or(f64::NAN, |exponent| f64::from(exponent.get()));
            Some(given).filter(|exponent| exponent.is_finite())
        };
        let warped = |exponents: Vec<f64>| {
            let smallest = storage.map_or(Some([0.0; 2]), |storage| {
                let found = of_storage(
                    "exponential_variance",
                    "EXPONENTIAL_VARIANCE_SMALLEST",
                    storage,
                )?;
                <[f64; 2]>::try_from(found).ok()
            })?;
            Some(Bound::Warped {
                exponents,
                smallest,
            })
        };
        let layered = |splits: Vec<f64>, overlap: f64| {
            let smallest = storage.map_or(Some(0.0), |storage| {
                let found = of_storage("two_moments", "TWO_MOMENTS_SMALLEST_VARIANCE", storage)?;
                found.first().copied()
            })?;
            Some(Bound::Layered {
                splits,
                overlap,
                smallest,
            })
        };
        let mut added = Vec::new();
        let bound = match technique {
            Technique::Binary | Technique::Pcf(_) | Technique::Pcss { .. } => return None,
            Technique::Esm { exponent: c, .. } => Bound::Exponential(exponent(c)?),
            Technique::Vsm => layered(Vec::new(), 0.0)?,
            Technique::Evsm2 { exponent: c } => warped(vec![exponent(c)?])?,
            Technique::Evsm4 { positive, negative } => {
                warped(vec![exponent(positive)?, -exponent(negative)?])?
            }
            Technique::Lvsm {
                layers,
                overlap,
                splits,
            } => layered(splits_of(*layers, splits)?, f64::from(overlap.get()))?,
            Technique::Convolution { terms, lower_bound } => {
                let bounds = numbers("convolution", "CONVOLUTION_BOUNDS")?;
                let of_terms = bounds.chunks_exact(2).nth(terms.checked_sub(1)? as usize)?;
                Bound::Series(FourierSeries {
                    terms: *terms,
                    damping: numbers("convolution", "CONVOLUTION_DAMPING")?[0],
                    shift: of_terms[0],
                    overshoot: of_terms[1],
                    is_bound: *lower_bound,
                })
            }
            Technique::Hamburger4 | Technique::Hausdorff4 => {
                let is_line = *technique == Technique::Hamburger4;
                if let Some(storage) = storage {
                    let bias = match is_line {
                        true => storage.moment_bias(),
                        false => storage.hausdorff_moment_bias(),
                    };
                    added = target(bias.alpha.into(), [bias.second, bias.fourth].map(f64::from));
                }
                match is_line {
                    true => Bound::Hamburger(2),
                    false => Bound::Hausdorff,
                }
            }
            Technique::Hamburger6 => {
                if let Some(storage) = storage {
                    let bias = storage.six_moments_bias()?;
                    added = target_of_six(bias.alpha.into(), bias.even.map(f64::from));
                }
                Bound::Hamburger(3)
            }
        };
        Some(Self { bound, added })
    }

    /// The same with the bias of a map that is encoded so.
    #[must_use]
    pub fn of_map(technique: &Technique, encoding: &MapEncoding) -> Option<Self> {
        let ideal = Self::of(technique, Some(encoding.storage()))?;
        if !encoding.is_rounded_inwards() {
            return Some(ideal);
        }
        let bias = encoding.storage().moment_bias_rounded_inwards();
        let added = target(bias.alpha.into(), [bias.second, bias.fourth].map(f64::from));
        Some(Self { added, ..ideal })
    }

    /// The shadow intensity at a fragment for surfaces at `depths` with `weights`.
    ///
    /// Moment depths in [-1, 1]; weights are not negative and sum to 1; both lists are equally long.
    #[must_use]
    pub fn shadow_intensity(&self, depths: &[f64], weights: &[f64], fragment_depth: f64) -> f64 {
        let surfaces = &Surfaces {
            depths,
            weights,
            added: &self.added,
        };
        match &self.bound {
            Bound::Exponential(c) => {
                (1.0 - surfaces.mean(|z| (c * (z - fragment_depth)).exp())).max(0.0)
            }
            Bound::Warped {
                exponents,
                smallest: [relative, least],
            } => {
                let of_warp = |&c: &f64| {
                    // The warp less that of the fragment, in units of the latter.
                    let warp = |z: f64| c.signum() * (c * (z - fragment_depth)).exp_m1();
                    let square = surfaces.mean(|z| (2.0 * c * (z - fragment_depth)).exp());
                    let least = least * (-2.0 * c * fragment_depth).exp();
                    surfaces.cantelli(warp, |_| relative * square + least)
                };
                exponents.iter().map(of_warp).fold(0.0, f64::max)
            }
            Bound::Layered {
                splits,
                overlap,
                smallest,
            } => of_layers(surfaces, fragment_depth, splits, *overlap, *smallest),
            Bound::Series(series) => series.of(surfaces, fragment_depth),
            Bound::Hamburger(degree) => moments::on_the_line(surfaces, fragment_depth, *degree),
            Bound::Hausdorff => moments::on_the_interval(surfaces, fragment_depth),
        }
    }
}

/// A number that a module has once for each storage.
fn of_storage(module: &str, name: &str, storage: Storage) -> Option<Vec<f64>> {
    numbers(module, &format!("{name}_{}", storage.name().to_uppercase()))
}

fn splits_of(layers: u32, splits: &LayerSplits) -> Option<Vec<f64>> {
    match splits {
        LayerSplits::Uniform => Some(
            (1..layers)
                .map(|layer| 2.0 * f64::from(layer) / f64::from(layers) - 1.0)
                .collect(),
        ),
        LayerSplits::Given(given) => Some(given.iter().map(|it| f64::from(it.get())).collect()),
        LayerSplits::Lloyd => None,
    }
}

/// Every layer gives a bound; the darkest one is shown.
fn of_layers(
    surfaces: &Surfaces<'_>,
    fragment_depth: f64,
    splits: &[f64],
    overlap: f64,
    smallest: f64,
) -> f64 {
    let of_layer = |layer: usize| {
        let first = match layer.checked_sub(1) {
            Some(before) => (splits[before] - overlap).max(-1.0),
            None => -1.0,
        };
        let last = splits
            .get(layer)
            .map_or(1.0, |split| (split + overlap).min(1.0));
        let receiver = fragment_depth.clamp(first, last);
        // The smallest variance belongs to depths from -1 to 1.
        let smallest = smallest * (0.5 * (last - first)).powi(2);
        surfaces.cantelli(|z| z.clamp(first, last) - receiver, |_| smallest)
    };
    (0..=splits.len()).map(of_layer).fold(0.0, f64::max)
}

/// Three surfaces with the second and fourth moment of a bias's target, weighted by its step.
fn target(alpha: f64, [second, fourth]: [f64; 2]) -> Vec<[f64; 2]> {
    let place = (fourth / second).sqrt();
    let each = 0.5 * second * second / fourth;
    [(-place, each), (0.0, 1.0 - 2.0 * each), (place, each)]
        .map(|(place, weight)| [place, alpha * weight])
        .to_vec()
}

/// Five surfaces with the second, fourth and sixth moment of a bias's target, weighted by its step.
fn target_of_six(alpha: f64, [second, fourth, sixth]: [f64; 3]) -> Vec<[f64; 2]> {
    // Both ends, and a pair of which z^2 (1 - z^2) and z^4 (1 - z^2) are what the ends do not have.
    let square = (fourth - sixth) / (second - fourth);
    let inner = 0.5 * (second - fourth) / (square * (1.0 - square));
    let end = 0.5 * second - inner * square;
    let place = square.sqrt();
    let middle = 1.0 - 2.0 * (inner + end);
    [
        (-1.0, end),
        (-place, inner),
        (0.0, middle),
        (place, inner),
        (1.0, end),
    ]
    .map(|(place, weight)| [place, alpha * weight])
    .to_vec()
}
