//! Mixtures of surfaces, evaluated by every technique on the adapter.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{EsmFiltering, Profile, Storage, Technique};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// The number of 8-bit unorm storage in the WGSL module `storage`.
pub(crate) const UNORM8: u32 = 3;

/// `LayeredVarianceLayers` of the module `layered_variance`.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(crate) struct Layers {
    pub(crate) splits: [f32; 8],
    pub(crate) count: u32,
    pub(crate) overlap: f32,
    pub(crate) padding: [f32; 2],
}

impl Layers {
    pub(crate) fn new(splits: &[f32], overlap: f32) -> Self {
        let mut all = [0.0; 8];
        all[..splits.len()].copy_from_slice(splits);
        Self {
            splits: all,
            count: splits.len() as u32 + 1,
            overlap,
            padding: [0.0; 2],
        }
    }
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Input {
    pub(crate) depths: [f32; 8],
    /// Multiples of 2^-10, so that their sum is exactly 1 and no product with a normal exponential is flushed to zero.
    pub(crate) weights: [f32; 8],
    pub(crate) layers: Layers,
    /// ESM plain and logarithmic, EVSM positive and negative.
    pub(crate) exponents: [f32; 4],
    pub(crate) fragment_depth: f32,
    pub(crate) storage: u32,
    pub(crate) terms: u32,
    pub(crate) padding: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Output {
    pub(crate) variance: f32,
    pub(crate) variance_upper: f32,
    pub(crate) layered: f32,
    pub(crate) exponential: f32,
    pub(crate) exponential_logarithmic: f32,
    pub(crate) exponential_filtered: f32,
    pub(crate) exponential_variance_2: f32,
    pub(crate) exponential_variance_4: f32,
    pub(crate) convolution: f32,
    pub(crate) convolution_series: f32,
    pub(crate) hamburger: f32,
    pub(crate) hausdorff: f32,
}

pub(crate) fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "mixture.wgsl", include_str!("mixture.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// The largest exponents that the modules state.
pub(crate) struct Limits {
    /// Plain and logarithmic.
    pub(crate) exponential: [f32; 2],
    pub(crate) exponential_variance: f32,
}

pub(crate) fn limits(storage: Storage) -> Limits {
    let esm = |filtering| Technique::Esm {
        exponent: None,
        filtering,
    };
    let evsm = Technique::Evsm2 { exponent: None };
    let of = |technique: Technique| {
        technique
            .row()
            .largest_exponent(storage)
            .unwrap_or_default()
    };
    Limits {
        exponential: [EsmFiltering::Linear, EsmFiltering::Logarithmic].map(|it| of(esm(it))),
        exponential_variance: of(evsm),
    }
}

impl Input {
    /// Surfaces (depth, weight), whose weights are multiples of 2^-10 and sum to 1.
    pub(crate) fn new(surfaces: &[(f32, f32)], fragment_depth: f32, storage: Storage) -> Self {
        assert_eq!(surfaces.iter().map(|surface| surface.1).sum::<f32>(), 1.0);
        let mut input = Self {
            depths: [0.0; 8],
            weights: [0.0; 8],
            layers: Layers::new(&[], 0.0),
            exponents: [3.0, 9.0, 5.0, 5.0],
            fragment_depth,
            storage: storage.wgsl_index(),
            terms: 8,
            padding: 0,
        };
        for (index, &(depth, weight)) in surfaces.iter().enumerate() {
            input.depths[index] = depth;
            input.weights[index] = weight;
        }
        input
    }

    pub(crate) fn surfaces(&self) -> impl Iterator<Item = (f64, f64)> {
        let surfaces = self.depths.into_iter().zip(self.weights);
        surfaces.map(|(depth, weight)| (f64::from(depth), f64::from(weight)))
    }

    /// The mean of a function of depth.
    pub(crate) fn mean(&self, function: impl Fn(f64) -> f64) -> f64 {
        self.surfaces()
            .map(|(depth, weight)| weight * function(depth))
            .sum()
    }

    /// The true shadow intensity: the share of depth in front of the fragment.
    pub(crate) fn truth(&self) -> f64 {
        let fragment = f64::from(self.fragment_depth);
        self.mean(|depth| f64::from(u8::from(depth < fragment)))
    }
}

/// One to eight surfaces with random weights: apart, close together, at the ends; a fragment anywhere or on one of them.
pub(crate) fn random(random: &mut ChaCha8Rng, storage: Storage) -> Input {
    let count = random.random_range(1..=8);
    let mut cuts: Vec<u32> = (1..count).map(|_| random.random_range(0..=1024)).collect();
    cuts.extend([0, 1024]);
    cuts.sort_unstable();
    let gap = 10.0_f32.powf(random.random_range(-6.0..0.0));
    let base = random.random_range(-1.0..=1.0_f32);
    let surfaces: Vec<(f32, f32)> = cuts
        .windows(2)
        .map(|cut| {
            let depth: f32 = match random.random_range(0..4) {
                0 => base + gap * random.random_range(-1.0..=1.0_f32),
                1 => [-1.0, 1.0][random.random_range(0..2)],
                _ => random.random_range(-1.0..=1.0),
            };
            (depth.clamp(-1.0, 1.0), (cut[1] - cut[0]) as f32 / 1024.0)
        })
        .collect();
    let fragment = match random.random_range(0..4) {
        0 => surfaces[random.random_range(0..surfaces.len())].0,
        1 => base + gap * random.random_range(-2.0..=2.0_f32),
        _ => random.random_range(-1.0..=1.0),
    };
    Input::new(&surfaces, fragment.clamp(-1.0, 1.0), storage)
}
