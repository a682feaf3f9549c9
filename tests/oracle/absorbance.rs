//! Translucent casters without an order: moments of absorbance, which add up (Münstermann et al., "Moment-Based Order-Independent
//! Transparency", 2018), beside moments of what is blended far to near, both in f64 without any rounding.
//!
//! `cargo test --release --test oracle -- absorbance --nocapture` prints the errors that `docs/translucent_casters/README.md` has.

use moment_shadows::{Kernel, Technique};
use moment_shadows_lab::oracle::ideal::Ideal;
use moment_shadows_lab::translucent::{Caster, Texture, stack};

/// By which part of the absorbance at a receiver's own depth the paper raises its lower bound.
const OVERESTIMATION: f64 = 0.25;

/// How far a shadow is from the truth: on average, and how much darker it is at most.
#[derive(Clone, Copy, Debug, Default)]
struct Errors {
    mean: f64,
    darker: f64,
}

/// A row of texels of the map, with casters far to near, and the weights of a filter.
struct Row {
    casters: Vec<Caster>,
    weights: Vec<f64>,
    /// Texels from this one on have casters.
    covered: usize,
}

impl Row {
    fn opacity(&self, caster: &Caster, texel: usize) -> f64 {
        if texel < self.covered {
            return 0.0;
        }
        caster.opacity_at([texel as u32, 0])
    }

    fn texels(&self) -> impl Iterator<Item = (usize, f64)> {
        self.weights.iter().copied().enumerate()
    }

    fn truth(&self, receiver: f64) -> f64 {
        let of_texel = |texel| {
            let before = self.casters.iter().filter(|caster| z(caster) < receiver);
            let light: f64 = before
                .map(|caster| 1.0 - self.opacity(caster, texel))
                .product();
            1.0 - light
        };
        self.texels()
            .map(|(texel, weight)| weight * of_texel(texel))
            .sum()
    }

    /// The bound of moments of 1 - transmittance; what passes everything lies at the far end.
    fn blended(&self, ideal: &Ideal, receiver: f64) -> f64 {
        let (mut depths, mut masses) = (Vec::new(), Vec::new());
        for (texel, weight) in self.texels() {
            let mut light = weight;
            for caster in self.casters.iter().rev() {
                let opacity = self.opacity(caster, texel);
                depths.push(z(caster));
                masses.push(opacity * light);
                light *= 1.0 - opacity;
            }
            depths.push(1.0);
            masses.push(light);
        }
        ideal.shadow_intensity(&depths, &masses, receiver)
    }

    /// The shadow by moments of absorbance, with some of what may lie at the receiver itself.
    fn absorbed(&self, ideal: &Ideal, receiver: f64, overestimation: f64) -> f64 {
        let (mut depths, mut masses) = (Vec::new(), Vec::new());
        for (texel, weight) in self.texels() {
            for caster in &self.casters {
                depths.push(z(caster));
                masses.push(-weight * (-self.opacity(caster, texel)).ln_1p());
            }
        }
        let total: f64 = masses.iter().sum();
        masses.iter_mut().for_each(|mass| *mass /= total);
        let least = ideal.shadow_intensity(&depths, &masses, receiver);
        let mirrored: Vec<f64> = depths.iter().map(|depth| -depth).collect();
        let most = 1.0 - ideal.shadow_intensity(&mirrored, &masses, -receiver);
        1.0 - (-total * (least + overestimation * (most - least).max(0.0))).exp()
    }

    /// Errors over receivers in front of casters, between them and behind: blended, by the lower bound of absorbance, and as the paper
    /// has it.
    fn errors(&self, ideal: &Ideal) -> [Errors; 3] {
        const RECEIVERS: u32 = 64;
        let mut all = [Errors::default(); 3];
        for index in 0..RECEIVERS {
            let receiver = 2.0 * (f64::from(index) + 0.7) / f64::from(RECEIVERS) - 1.0;
            let truth = self.truth(receiver);
            let found = [
                self.blended(ideal, receiver),
                self.absorbed(ideal, receiver, 0.0),
                self.absorbed(ideal, receiver, OVERESTIMATION),
            ];
            for (found, errors) in found.into_iter().zip(&mut all) {
                errors.mean += (found - truth).abs() / f64::from(RECEIVERS);
                errors.darker = errors.darker.max(found - truth);
            }
        }
        all
    }
}

/// The moment depth of a caster.
fn z(caster: &Caster) -> f64 {
    2.0 * f64::from(caster.depth) - 1.0
}

#[test]
fn absorbance_tells_more_casters_apart_and_is_too_dark_where_a_filter_meets_an_edge() {
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    let gaussian: Vec<f64> = kernel.weights().iter().map(|&it| it.into()).collect();
    println!(
        "percent, mean (darker at most): blended, lower bound of absorbance, absorbance as the paper has it"
    );
    for technique in [Technique::Hamburger4, Technique::Hamburger6] {
        let ideal = Ideal::of(&technique, None).unwrap();
        for count in [1, 2, 4, 8, 16] {
            let errors = |name: &str, texture, weights: &[f64], covered| {
                let row = Row {
                    casters: stack(count, false, texture),
                    weights: weights.to_vec(),
                    covered,
                };
                let errors = row.errors(&ideal);
                let text =
                    errors.map(|it| format!("{:6.2} ({:.2})", 100.0 * it.mean, 100.0 * it.darker));
                println!("{technique:?} {count:>2} {name:<9} {}", text.join("  "));
                errors
            };
            let [blended, absorbed, _] = errors("uniform", Texture::Even, &[1.0], 0);
            let [textured, too_dark, _] = errors("textured", Texture::Hashed, &gaussian, 0);
            let [edge, darkest, _] = errors("an edge", Texture::Even, &gaussian, 4);
            // What is blended is bounded, whatever the filter.
            for bound in [blended, textured, edge] {
                assert!(bound.darker < 1e-6, "{bound:?}");
            }
            // One caster is known exactly; a mean of its absorbance stands for less light than there is.
            if count == 1 {
                assert!(blended.mean.max(textured.mean).max(edge.mean) < 1e-6);
                assert!(darkest.mean > 0.04, "{darkest:?}");
            }
            assert!(darkest.darker > 0.08 && too_dark.darker > 0.02);
            if count >= 4 {
                assert!(absorbed.mean < 0.8 * blended.mean, "{absorbed:?}");
            }
        }
    }
}
