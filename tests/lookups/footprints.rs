//! Footprints of pixels: the variance of what a lookup averages is that of the pixel, along both of its axes.

use bytemuck::{Pod, Zeroable};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

const SHADER: &str = "
import moment_shadows::map::minification::{minification_footprint, minification_probe};

struct BatchInput {
    difference_x: vec2f,
    difference_y: vec2f,
    anisotropy: f32,
    padding: f32,
}

struct BatchOutput {
    // The first probe, and the last.
    first: vec2f,
    last: vec2f,
    probes: f32,
    level: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    let footprint = minification_footprint(input.difference_x, input.difference_y, input.anisotropy);
    return BatchOutput(
        minification_probe(footprint, 0.0),
        minification_probe(footprint, footprint.probes - 1.0),
        footprint.probes,
        footprint.level,
    );
}
";

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Pixel {
    pub(crate) difference_x: [f32; 2],
    pub(crate) difference_y: [f32; 2],
    pub(crate) anisotropy: f32,
    padding: f32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    first: [f32; 2],
    last: [f32; 2],
    probes: f32,
    level: f32,
}

/// Pixels of all shapes up to `longest` texels, in all directions.
pub(crate) fn pixels(seed: u64, count: usize, longest: f64) -> Vec<Pixel> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let pixel = |_| {
        let length = |random: &mut ChaCha8Rng| longest.powf(random.random_range(-0.3..1.0));
        let (first, second) = (length(&mut random), length(&mut random));
        let (turn, spin) = (
            random.random_range(0.0..std::f64::consts::TAU),
            random.random_range(0.0..std::f64::consts::TAU),
        );
        // An ellipse with these axes, turned, and two conjugate half axes of it.
        let at = |angle: f64| {
            let (x, y) = (first * angle.cos(), second * angle.sin());
            [
                x * turn.cos() - y * turn.sin(),
                x * turn.sin() + y * turn.cos(),
            ]
            .map(|it| it as f32)
        };
        Pixel {
            difference_x: at(spin),
            difference_y: at(spin + std::f64::consts::FRAC_PI_2),
            anisotropy: [1.0, 2.0, 4.0, 7.0, 16.0][random.random_range(0..5)],
            padding: 0.0,
        }
    };
    (0..count).map(pixel).collect()
}

impl Pixel {
    /// The major axis of the ellipse x cos t + y sin t, and the length of the minor one, by the angle t at which it is longest.
    pub(crate) fn axes(&self) -> ([f64; 2], f64) {
        let [x, y] = [self.difference_x, self.difference_y].map(|it| it.map(f64::from));
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let angle = 0.5 * (2.0 * dot(x, y)).atan2(dot(x, x) - dot(y, y));
        let at = |angle: f64| [0, 1].map(|axis| x[axis] * angle.cos() + y[axis] * angle.sin());
        let minor = at(angle + std::f64::consts::FRAC_PI_2);
        (at(angle), dot(minor, minor).sqrt())
    }
}

#[test]
fn probes_lie_around_the_centre_and_add_up_to_the_pixel() {
    let pixels = pixels(21, 4000, 60.0);
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let shader = Batch::<Pixel, Output>::new(&gpu, "footprints.wgsl", SHADER).unwrap();
    let (mut several, mut limited) = (0, 0);
    for (pixel, found) in pixels.iter().zip(shader.run(&pixels).unwrap()) {
        let (major, minor) = pixel.axes();
        let length = major[0].hypot(major[1]);
        let count = f64::from(found.probes);
        assert!(
            count >= 1.0 && count <= f64::from(pixel.anisotropy) && count.fract() == 0.0,
            "{pixel:?}: {found:?}"
        );
        let [first, last] = [found.first, found.last].map(|it| it.map(f64::from));
        // Rounding of the axes, 2^-22 of them or so.
        let slack = 1e-5 * length.max(1.0);
        for axis in [0, 1] {
            assert!(
                (first[axis] + last[axis]).abs() < slack,
                "{pixel:?}: {found:?}"
            );
        }
        let between = [last[0] - first[0], last[1] - first[1]];
        let across = (between[0] * major[1] - between[1] * major[0]).abs() / length;
        // Where both axes are alike, their direction is rounding's.
        assert!(
            across < 1e-3 * length || length - minor < 1e-2 * length,
            "{pixel:?}: {found:?} beside {major:?}"
        );
        let texel = f64::from(found.level).exp2();
        let spacing = between[0].hypot(between[1]) / (count - 1.0).max(1.0);
        // Probes are as far apart as their texels are wide, at most, so that they leave no gap.
        assert!(spacing <= texel * (1.0 + 2e-3), "{pixel:?}: {found:?}");
        // Trilinear lookups on texels of width t have the variance t^2 / 4, and an axis as a box has its length^2 / 12. One
        // shorter than a texel counts as a texel; below sqrt(3) of them a lookup cannot be that narrow.
        let lookup = texel * texel / 4.0;
        let box_of = |length: f64| length.max(1.0).powi(2) / 12.0;
        if count > 1.0 {
            several += 1;
            // A line of n probes that fill it has n^2 / (n^2 - 1) times the variance of the probes themselves.
            let line = (spacing * count).powi(2) / 12.0;
            let expected = box_of(length);
            let found_along = line + texel.powi(2).max(3f64.recip()) / 4.0;
            if texel > 1.0 {
                assert!(
                    (found_along / expected - 1.0).abs() < 1e-4,
                    "{pixel:?}: {found_along} along, not {expected}"
                );
            }
        }
        if texel > 1.0 && count < f64::from(pixel.anisotropy) {
            let expected = box_of(minor);
            assert!(
                (lookup / expected - 1.0).abs() < 1e-4,
                "{pixel:?}: {lookup} across, not {expected}"
            );
        }
        if count == f64::from(pixel.anisotropy) && texel > 1.0 {
            limited += 1;
            assert!(
                lookup >= box_of(minor) * (1.0 - 1e-4),
                "{pixel:?}: {found:?}"
            );
        }
    }
    assert!(several > 1000 && limited > 500, "{several}, {limited}");
}
