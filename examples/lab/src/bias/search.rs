//! The search itself and its table.

use core::fmt;

use moment_shadows::{Storage, Technique};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::casters::casters;
use super::definite::{Condition, Repair};
use super::form::Form;
use super::{patch, pipeline, scaling};
use crate::error::LabError;

/// Patches per stream of random numbers, so that figures do not depend on the number of threads.
const PER_STREAM: usize = 4096;

/// The share of samples that a recommended bias repairs.
const COVERED: f64 = 0.99999;

/// Recommended biases are one of these times a power of ten.
const STEPS: [f64; 9] = [1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];

/// Which solver the bias is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, clap::ValueEnum)]
#[serde(rename_all = "lowercase")]
pub enum BiasTechnique {
    /// Four moments on the real line.
    Hamburger4,
    /// Four moments on [-1, 1].
    Hausdorff4,
    /// Six moments on the real line.
    Hamburger6,
}

impl BiasTechnique {
    /// What moments have to fulfil.
    #[must_use]
    pub fn condition(self) -> Condition {
        match self {
            BiasTechnique::Hamburger4 | BiasTechnique::Hamburger6 => Condition::Line,
            BiasTechnique::Hausdorff4 => Condition::Interval,
        }
    }

    /// The storages that are searched where none is chosen.
    #[must_use]
    pub fn storages(self) -> &'static [Storage] {
        match self {
            // Packed texels round no moments: they are valid by themselves.
            BiasTechnique::Hamburger4 => &Storage::OF_FOUR_MOMENTS,
            BiasTechnique::Hausdorff4 => Technique::Hausdorff4.row().storages,
            BiasTechnique::Hamburger6 => Technique::Hamburger6.row().storages,
        }
    }
}

/// The smallest alphas that repair shares of the samples.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantiles {
    /// 99.999 % of all samples.
    pub most: f64,
    /// All samples; infinite if no alpha repairs one of them.
    pub all: f64,
    /// The share of samples that no alpha repairs.
    pub beyond_repair: f64,
}

/// One way to store moments.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BiasRow {
    /// Its name.
    pub form: String,
    /// b*.
    pub target: Vec<f64>,
    /// Exact moments, rounded once.
    pub one_rounding: Quantiles,
    /// Both passes of a blur that resolves, each rounded; without translucent casters, which it cannot have.
    pub two_roundings: Quantiles,
    /// Rounded inwards after both passes of a blur that resolves and packs texels in between; none for forms that are not rounded so.
    pub inwards: Option<Quantiles>,
    /// Resolve, every blend and both passes of a blur, each rounded.
    pub three_roundings: Quantiles,
    /// K: alpha per error of a channel, to first order, for the worst moments and the worst errors.
    pub error_factor: f64,
    /// K times the error of one rounding.
    pub bound: f64,
    /// `three_roundings.most`, rounded up.
    pub recommended: f64,
    /// What the library applies.
    pub library: Option<f64>,
    /// What the library applies to maps that are rounded inwards: three times what all texels need, since filters and evaluation round, too.
    pub library_inwards: Option<f64>,
}

/// All rows of a search.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BiasTable {
    /// What the bias is for.
    pub technique: BiasTechnique,
    /// Translucent casters that are blended over each patch.
    pub blends: u32,
    /// Patches per row.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// The storages of the library, and published forms.
    pub rows: Vec<BiasRow>,
}

/// Searches the smallest safe bias of one storage, or of all and of the published forms. `step` is called after every few
/// thousand samples.
pub fn search(
    technique: BiasTechnique,
    storage: Option<Storage>,
    (blends, samples, seed): (u32, usize, u64),
    step: impl Fn() + Sync,
) -> Result<BiasTable, LabError> {
    if let Some(storage) = storage.filter(|it| it.is_packed()) {
        return Err(LabError::refused(format!(
            "texels as {storage} are valid moments by themselves, so that there is nothing to search; choose one of unorm16, float16 and \
             float32"
        )));
    }
    let storages = storage.map_or(technique.storages().to_vec(), |storage| vec![storage]);
    let mut rows = Vec::new();
    for storage in storages {
        let (mut row, alpha) = match technique {
            BiasTechnique::Hamburger4 => {
                let form = Form::of_library(storage, Condition::Line);
                let row = measure(&form, (blends, samples, seed), &step)?;
                (row, storage.moment_bias().with_blends(blends).alpha)
            }
            BiasTechnique::Hausdorff4 => {
                let form = Form::of_library(storage, Condition::Interval);
                let row = measure(&form, (blends, samples, seed), &step)?;
                (
                    row,
                    storage.hausdorff_moment_bias().with_blends(blends).alpha,
                )
            }
            BiasTechnique::Hamburger6 => {
                let form = Form::of_six_moments(storage).zip(storage.six_moments_bias());
                let (form, bias) = form.ok_or_else(|| {
                    LabError::refused(format!(
                        "'hamburger6' is not stored as {storage}; choose one of unorm16, float16, float32 and unorm10"
                    ))
                })?;
                (
                    measure(&form, (blends, samples, seed), &step)?,
                    bias.with_blends(blends).alpha,
                )
            }
        };
        row.library = Some(f64::from(alpha));
        rows.push(row);
    }
    if storage.is_none() && technique == BiasTechnique::Hamburger4 {
        for form in Form::published() {
            rows.push(measure(&form, (blends, samples, seed), &step)?);
        }
    }
    Ok(BiasTable {
        technique,
        blends,
        samples,
        seed,
        rows,
    })
}

/// Searches the smallest safe bias of one form.
pub fn measure<const M: usize>(
    form: &Form<M>,
    (blends, samples, seed): (u32, usize, u64),
    step: impl Fn() + Sync,
) -> Result<BiasRow, LabError> {
    if samples == 0 {
        return Err(LabError::refused(
            "0 samples were asked for; ask for at least 1, and for at least 100000 to see the 99.999th percentile",
        ));
    }
    let weights = pipeline::weights();
    let inward_bias = form.inward_bias();
    let repair = Repair::new(form.interval, form.condition, form.target);
    let alphas: Vec<[f64; 4]> = (0..samples.div_ceil(PER_STREAM))
        .into_par_iter()
        .flat_map_iter(|stream| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(stream as u64);
            let count = PER_STREAM.min(samples - stream * PER_STREAM);
            let alphas: Vec<[f64; 4]> = (0..count)
                .map(|_| {
                    let patch = patch::patch(&mut random);
                    // Without casters no random number is drawn, and patches are those of every search.
                    let casters = casters(&mut random, blends as usize);
                    let inwards =
                        inward_bias.map(|alpha| pipeline::inwards(form, &patch, &weights, alpha));
                    let alpha = |moments| repair.smallest_alpha(moments);
                    [
                        alpha(pipeline::one_rounding(form, &patch, &weights)),
                        alpha(pipeline::two_roundings(form, &patch, &weights)),
                        alpha(pipeline::three_roundings(form, &patch, &casters, &weights)),
                        inwards.map_or(0.0, |moments| moments.map_or(f64::INFINITY, alpha)),
                    ]
                })
                .collect();
            step();
            alphas
        })
        .collect();
    let [one_rounding, two_roundings, three_roundings, inwards] =
        [0, 1, 2, 3].map(|stage| quantiles(alphas.iter().map(|alpha| alpha[stage]).collect()));
    let inwards = inward_bias.map(|_| inwards);
    let error_factor = scaling::error_factor(form);
    Ok(BiasRow {
        form: form.name.clone(),
        target: form.target.to_vec(),
        one_rounding,
        two_roundings,
        inwards,
        three_roundings,
        error_factor,
        bound: error_factor * form.error(),
        recommended: round_up(three_roundings.most),
        library: None,
        library_inwards: inward_bias,
    })
}

/// Both quantiles of some alphas.
pub(super) fn quantiles(mut alphas: Vec<f64>) -> Quantiles {
    alphas.sort_by(f64::total_cmp);
    let count = alphas.len();
    let place = ((COVERED * count as f64).ceil() as usize).clamp(1, count) - 1;
    let lost = alphas.iter().filter(|alpha| alpha.is_infinite()).count();
    Quantiles {
        most: alphas[place],
        all: alphas[count - 1],
        beyond_repair: lost as f64 / count as f64,
    }
}

fn round_up(alpha: f64) -> f64 {
    if alpha <= 0.0 || alpha.is_infinite() {
        return alpha;
    }
    let power = 10.0_f64.powf(alpha.log10().floor());
    // Digits that rounding adds do not count.
    let step = STEPS
        .into_iter()
        .find(|step| alpha <= step * power * (1.0 + 1e-9));
    step.unwrap_or(10.0) * power
}

impl fmt::Display for BiasTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let technique = match self.technique {
            BiasTechnique::Hamburger4 => "Hamburger 4 (Hankel matrix positive definite)",
            BiasTechnique::Hausdorff4 => "Hausdorff 4 (both Hankel matrices positive definite)",
            BiasTechnique::Hamburger6 => "Hamburger 6 (Hankel matrix positive definite)",
        };
        writeln!(
            f,
            "Smallest moment bias alpha for {technique}: {} patches of 9 x 9 texels, seed {}\n\
             one: exact filtered moments rounded once; inwards: a two-pass Gaussian that resolves, packed texels in between, rounded inwards; two: a two-pass Gaussian that resolves, each pass rounded; three: resolve{} and a two-pass Gaussian of deviation 2.4, each rounded\n",
            self.samples,
            self.seed,
            match self.blends {
                0 => String::new(),
                blends => format!(", {blends} translucent casters blended one after the other"),
            }
        )?;
        writeln!(
            f,
            "| form | b* | one 99.999 % | one 100 % | inwards 99.999 % | inwards 100 % | two 99.999 % | two 100 % | three 99.999 % | three 100 % | K | K error | recommended | library | inwards: library |"
        )?;
        writeln!(
            f,
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
        )?;
        for row in &self.rows {
            let target: Vec<String> = row
                .target
                .iter()
                .map(|moment| format!("{moment:.4}"))
                .collect();
            write!(f, "| {} | {} |", row.form, target.join(" "))?;
            let all = [
                Some(row.one_rounding),
                row.inwards,
                Some(row.two_roundings),
                Some(row.three_roundings),
            ];
            for quantiles in all {
                let Some(quantiles) = quantiles else {
                    write!(f, " - | - |")?;
                    continue;
                };
                for alpha in [quantiles.most, quantiles.all] {
                    if alpha.is_finite() {
                        write!(f, " {alpha:.3e} |")?;
                    } else {
                        let share = 100.0 * quantiles.beyond_repair;
                        write!(f, " none for {share:.1} % |")?;
                    }
                }
            }
            write!(
                f,
                " {:.3} | {:.3e} | {:.1e} |",
                row.error_factor, row.bound, row.recommended
            )?;
            for alpha in [row.library, row.library_inwards] {
                match alpha {
                    Some(alpha) => write!(f, " {alpha:.1e} |")?,
                    None => write!(f, " - |")?,
                }
            }
            writeln!(f)?;
        }
        Ok(())
    }
}

/// How often [`measure`] calls its `step`.
#[must_use]
pub fn steps(samples: usize) -> usize {
    samples.div_ceil(PER_STREAM)
}
