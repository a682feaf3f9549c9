//! The lower bounds that techniques give for known surfaces when nothing is rounded and nothing biased, in f64.
//!
//! What a technique's storage and its shader add to these is their error; what these lack to the truth is the technique's
//! own. Distances are taken from the fragment wherever moments would cancel.

mod kernel;
mod series;
mod variance;

use core::fmt;

pub use series::FourierSeries;

use crate::truth::exact_bound;

/// A technique without errors.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Ideal {
    /// Two moments (Donnelly & Lauritzen, i3D 2006): Cantelli's inequality.
    Vsm,
    /// E[e^(c z)] (Annen et al., 2008): Markov's inequality. The exponent is per unit of moment depth; on [0, 1] it would be
    /// twice as large.
    Esm {
        /// c.
        exponent: f64,
    },
    /// Two moments of e^(c z) (Lauritzen, thesis 2008, section 4.3).
    Evsm2 {
        /// c.
        exponent: f64,
    },
    /// [`Ideal::Evsm2`] and two moments of -e^(-d z); the darker of both.
    Evsm4 {
        /// c.
        positive: f64,
        /// d.
        negative: f64,
    },
    /// Two moments within each of several layers of depth (Lauritzen, thesis 2008, section 4.1), uniform and of depths
    /// clamped to the layer; the receiver's layer counts.
    Lvsm {
        /// How many.
        layers: u32,
        /// By how much of its thickness each layer is extended on either side.
        overlap: f64,
    },
    /// A Fourier series of the step, shifted and lowered to a bound (Annen et al., 2007).
    Convolution(FourierSeries),
    /// Four power moments on the real line (Peters & Klein, i3D 2015).
    Hamburger4,
    /// Six power moments on the real line.
    Hamburger6,
    /// Four power moments on [-1, 1].
    Hausdorff4,
}

impl Ideal {
    /// The technique's lower bound of the shadow intensity at a fragment, for surfaces at `depths` with `weights`.
    ///
    /// Moment depths in [-1, 1]; weights are not negative and sum to 1; both lists are equally long.
    #[must_use]
    pub fn lower_bound(&self, depths: &[f64], weights: &[f64], fragment_depth: f64) -> f64 {
        let surfaces = Surfaces { depths, weights };
        let relative =
            |warp: &dyn Fn(f64) -> f64| variance::cantelli(&surfaces, |z| warp(z - fragment_depth));
        match self {
            Ideal::Vsm => relative(&|t| t),
            Ideal::Esm { exponent } => {
                (1.0 - surfaces.mean(|z| (exponent * (z - fragment_depth)).exp())).max(0.0)
            }
            // Less one, so that the fragment is at zero.
            Ideal::Evsm2 { exponent } => relative(&|t| (exponent * t).exp_m1()),
            Ideal::Evsm4 { positive, negative } => {
                let first = relative(&|t| (positive * t).exp_m1());
                first.max(relative(&|t| -(-negative * t).exp_m1()))
            }
            Ideal::Lvsm { layers, overlap } => {
                let [first, last] = layer(*layers, *overlap, fragment_depth);
                let receiver = fragment_depth.clamp(first, last);
                variance::cantelli(&surfaces, |z| z.clamp(first, last) - receiver)
            }
            Ideal::Convolution(series) => series.lower_bound(&surfaces, fragment_depth),
            Ideal::Hamburger4 => exact_bound::lower_bound(depths, weights, fragment_depth),
            Ideal::Hamburger6 => kernel::lower_bound(&surfaces, fragment_depth, 3),
            Ideal::Hausdorff4 => variance::hausdorff(&surfaces, fragment_depth),
        }
    }
}

impl fmt::Display for Ideal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Ideal::Vsm => write!(f, "VSM"),
            Ideal::Esm { exponent } => write!(f, "ESM, {exponent}"),
            Ideal::Evsm2 { exponent } => write!(f, "EVSM2, {exponent}"),
            Ideal::Evsm4 { positive, negative } => write!(f, "EVSM4, {positive}/{negative}"),
            Ideal::Lvsm { layers, overlap } => {
                write!(f, "LVSM, {layers} layers, overlap {overlap}")
            }
            Ideal::Convolution(series) => write!(f, "convolution, {} terms", series.terms()),
            Ideal::Hamburger4 => write!(f, "Hamburger, 4 moments"),
            Ideal::Hamburger6 => write!(f, "Hamburger, 6 moments"),
            Ideal::Hausdorff4 => write!(f, "Hausdorff, 4 moments"),
        }
    }
}

/// The ends of the layer in which a depth lies.
fn layer(layers: u32, overlap: f64, depth: f64) -> [f64; 2] {
    let count = f64::from(layers.max(1));
    let thickness = 2.0 / count;
    let index = ((depth + 1.0) / thickness).floor().clamp(0.0, count - 1.0);
    let first = index * thickness - 1.0;
    [
        first - overlap * thickness,
        first + (1.0 + overlap) * thickness,
    ]
}

/// Depths with their weights.
struct Surfaces<'a> {
    depths: &'a [f64],
    weights: &'a [f64],
}

impl Surfaces<'_> {
    fn mean(&self, value: impl Fn(f64) -> f64) -> f64 {
        self.depths
            .iter()
            .zip(self.weights)
            .map(|(&z, weight)| weight * value(z))
            .sum()
    }
}
