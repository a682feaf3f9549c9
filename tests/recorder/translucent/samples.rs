//! Which of several opaque samples a translucent caster is tested against: what each rule does to the share of light that is shadowed.

use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// A texel: the depths of its opaque samples, and a translucent caster.
struct Texel {
    samples: [f64; 4],
    depth: f64,
    opacity: f64,
}

impl Texel {
    /// How much of the light is shadowed at a depth: the mean over the samples, each with the caster if it lies before it.
    fn truth(&self, receiver: f64) -> f64 {
        let of_sample = |&sample: &f64| {
            let passes = self.depth < sample && self.depth < receiver;
            let light = if passes { 1.0 - self.opacity } else { 1.0 };
            if sample < receiver { 0.0 } else { light }
        };
        1.0 - self.samples.iter().map(of_sample).sum::<f64>() / 4.0
    }

    /// The same where the caster is blended into the mean of the samples with this share of its opacity.
    fn blended(&self, share: f64, receiver: f64) -> f64 {
        let before = self.samples.iter().filter(|&&sample| sample < receiver);
        let opaque = before.count() as f64 / 4.0;
        let opacity = share * self.opacity;
        let caster = f64::from(self.depth < receiver);
        (1.0 - opacity) * opaque + opacity * caster
    }
}

#[test]
fn every_rule_keeps_the_bound_and_the_farthest_sample_is_exact_behind_all() {
    let mut random = ChaCha8Rng::seed_from_u64(48);
    let mut depth = || random.random_range(0.0..1.0);
    // Farthest, nearest, the share of samples; behind everything and before.
    let mut errors = [[0.0; 2]; 3];
    const TEXELS: u32 = 100_000;
    for _ in 0..TEXELS {
        let (one, other) = (depth(), depth());
        let samples = [one, one, other, if depth() < 0.5 { one } else { other }];
        let texel = Texel {
            samples,
            depth: depth(),
            opacity: depth(),
        };
        let passed = samples.iter().filter(|&&sample| texel.depth < sample);
        let passed = passed.count();
        let shares = [
            f64::from(passed > 0),
            f64::from(passed == 4),
            passed as f64 / 4.0,
        ];
        // Behind the caster and what is nearest of the opaque ones, and anywhere.
        let behind = texel.depth.max(one.min(other)) + 1e-9;
        for (place, receiver) in [behind, depth()].into_iter().enumerate() {
            let truth = texel.truth(receiver);
            for (share, errors) in shares.iter().zip(&mut errors) {
                let found = texel.blended(*share, receiver);
                assert!(found <= truth + 1e-12, "{found} above {truth}");
                errors[place] += (truth - found) / f64::from(TEXELS);
            }
        }
    }
    println!(
        "missing shadow, behind and anywhere: farthest, nearest, share of samples: {errors:.4?}"
    );
    let [farthest, nearest, share] = errors;
    assert!(farthest[0] < 1e-9, "{farthest:?}");
    assert!(
        nearest[0] > 0.01 && share[0] > 0.01,
        "{nearest:?} {share:?}"
    );
}
