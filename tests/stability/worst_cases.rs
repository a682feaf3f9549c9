//! Inputs that the stability report found to be the worst, and what each showed.

use std::collections::BTreeMap;

use moment_shadows::{DepthConversion, Profile};
use moment_shadows_lab::command::stability::pairs;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::stability::input::Input;
use moment_shadows_lab::stability::shader::Evaluator;
use moment_shadows_lab::stability::strata::Stratum;
use moment_shadows_lab::stability::truth::truth;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// By how much each result is above the truth.
fn excesses(technique: &str, storage: &str, inputs: &[Input]) -> Vec<f64> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let pairs = pairs(Some(technique), Some(storage)).unwrap();
    let evaluator = Evaluator::new(&gpu, &pairs[0]).unwrap();
    let found = evaluator.run(inputs).unwrap();
    let results = inputs.iter().zip(found);
    results
        .map(|(input, found)| {
            assert!((0.0..=1.0).contains(&found), "{input:?} gave {found}");
            f64::from(found) - truth(input, evaluator.kernels()).unwrap()
        })
        .collect()
}

#[test]
fn print_by_kernel() {
    let mut random = ChaCha8Rng::seed_from_u64(129);
    let inputs: Vec<Input> = [Stratum::Filtered, Stratum::FilteredWide]
        .into_iter()
        .flat_map(|s| (0..400_000).map(move |_| s))
        .map(|s| s.sample(&mut random))
        .collect();
    for technique in ["vsm", "lvsm", "evsm4", "hamburger4", "hausdorff4"] {
        let mut by: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        for (input, excess) in inputs.iter().zip(excesses(technique, "float32", &inputs)) {
            by.entry(input.kernel).or_default().push(excess);
        }
        for (kernel, mut e) in by {
            e.sort_by(f64::total_cmp);
            let n = e.len();
            println!(
                "{technique} kernel {kernel}: 99.9 {:.2e} 99.99 {:.2e} max {:.2e}",
                e[n * 999 / 1000],
                e[n * 9999 / 10000],
                e[n - 1]
            );
        }
    }
    let _ = DepthConversion::orthographic();
}
