//! Whether the figures move as theory says when something is made better or worse.

use glam::DVec3;
use moment_shadows::{FourMomentsBias, Storage};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::GraphFrame;
use moment_shadows_lab::judgement::{PictureTruth, Unfiltered};
use moment_shadows_lab::metric::{Comparison, compare};
use moment_shadows_lab::scene::{self, Scene, Stand};
use moment_shadows_lab::surface_error::SurfaceErrors;

use crate::setup::{frame, graph, open, options, plate, scene as scene_of, subject};

/// A picture's truth from a map so fine that its texels hardly matter, under a kernel of the same width in the scene as
/// that of a radius of 1 in a map of 256 texels.
fn fine_truth(gpu: &Gpu, scene: &Scene) -> PictureTruth {
    let radius = 8;
    let frame = frame(gpu, scene, (2048, 4), radius);
    let unfiltered = Unfiltered::of(gpu, &frame, &graph(Storage::Float32, radius)).unwrap();
    unfiltered.picture(gpu, &frame).unwrap()
}

/// The error of the picture from a map of `map` texels with `samples` each.
fn picture_error(
    gpu: &Gpu,
    scene: &Scene,
    [map, samples, radius]: [u32; 3],
    truth: &PictureTruth,
) -> Comparison {
    let file = graph(Storage::Float32, radius)
        .in_single_precision()
        .unwrap();
    let frame = frame(gpu, scene, (map, samples), radius);
    let graph_frame = GraphFrame::new(gpu, &frame, &file).unwrap();
    graph_frame.run(gpu).unwrap();
    let shadow = graph_frame.read_shadow(gpu, &file).unwrap();
    compare(&shadow, &truth.shadow, &truth.facing).unwrap()
}

#[test]
fn the_moment_bias_keeps_shadows_from_being_too_dark_and_leaks() {
    let gpu = open();
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        let subject = subject(&gpu, &scene, &options(256, 4), 4);
        for storage in Storage::OF_FOUR_MOMENTS {
            let own = storage.moment_bias();
            // Almost no bias, the storage's own, and ten times that. The shader does not take 0 itself: its guards against
            // moments that belong to no distribution are multiples of the bias.
            let [removed, recommended, tenfold] = [1e-7, 1.0, 10.0].map(|factor| {
                let bias = FourMomentsBias {
                    alpha: own.alpha * factor,
                    ..own
                };
                let errors = subject.judge(&gpu, &graph(storage, 4), Some(bias));
                errors.unwrap().surfaces
            });
            println!("{name} {storage}");
            for errors in [&removed, &recommended, &tenfold] {
                println!("  {:?}\n  {:?}", errors.shading, errors.distribution);
            }
            // Without it rounding decides what the moments say, and a bound on what they say does not bound the truth. With it
            // the bound holds for the truth, to what single precision can add.
            let too_dark = |errors: &SurfaceErrors| errors.distribution.overdarkening;
            assert!(too_dark(&recommended) < 2e-6, "{name} {storage}");
            assert!(too_dark(&removed) > 2e-4, "{name} {storage}");
            // Sums in single precision are off by their last rounding only, which little in a picture depends on.
            let more = if storage == Storage::Float32 {
                1.0
            } else {
                1.1
            };
            assert!(
                removed.shading.overdarkening > more * recommended.shading.overdarkening,
                "{name} {storage}"
            );
            // What it costs: it moves every distribution away from the truth, so that its lower bound falls, the farther the
            // more of it there is (the leak's range grows with the square root of alpha).
            let leaking: [fn(&SurfaceErrors) -> f64; 2] = [
                |errors| errors.shading.leaking,
                |errors| errors.distribution.leaking,
            ];
            for of in leaking {
                let [removed, recommended, tenfold] = [&removed, &recommended, &tenfold].map(of);
                assert!(removed < recommended, "{name} {storage}");
                assert!(recommended < tenfold, "{name} {storage}");
            }
        }
        // The smaller a storage's bias, the less it leaks.
        let [unorm16, float16, float32] = Storage::OF_FOUR_MOMENTS.map(|storage| {
            let errors = subject.judge(&gpu, &graph(storage, 4), None).unwrap();
            errors.surfaces.shading.leaking
        });
        assert!(float32 < unorm16 && unorm16 < float16, "{name}");
    }
}

#[test]
fn halving_the_map_is_seen_in_the_picture() {
    // A kernel of as many texels is twice as wide in the scene, and covers more depths: what is within it of a shadow's
    // edge differs from a truth that stays the same. Along straight edges that alone doubles the error.
    let gpu = open();
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        let truth = fine_truth(&gpu, &scene);
        let errors = [512, 256, 128].map(|map| {
            let error = picture_error(&gpu, &scene, [map, 4, 4], &truth).facing;
            error.mean_absolute
        });
        println!("{name}: {errors:?}");
        assert!(errors[1] > 1.5 * errors[0], "{name}: {errors:?}");
        assert!(errors[2] > 1.3 * errors[1], "{name}: {errors:?}");
    }
}

#[test]
fn dropping_samples_is_seen_in_the_picture() {
    // One sample says of a texel all or nothing where four can say a quarter: jagged edges, under a kernel too narrow to
    // hide them. The truth has that kernel's width, so that it is not the blur that is compared.
    let gpu = open();
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        let truth = fine_truth(&gpu, &scene);
        let [four, one] =
            [4, 1].map(|samples| picture_error(&gpu, &scene, [256, samples, 1], &truth));
        println!("{name}\n{four}\n{one}");
        assert!(
            one.facing.mean_absolute > 1.05 * four.facing.mean_absolute,
            "{name}"
        );
        assert!(
            one.penumbra.mean_absolute > 1.05 * four.penumbra.mean_absolute,
            "{name}"
        );
    }
}

#[test]
fn doubling_the_kernel_leaks_more() {
    // The more texels a kernel covers, the more depths four moments have to describe: two of them they describe without
    // an error, of more the bound falls short.
    let gpu = open();
    for name in scene::PROCEDURAL {
        let scene = scene::load(name).unwrap();
        let figures = [2, 4, 8].map(|radius| {
            let subject = subject(&gpu, &scene, &options(256, 4), radius);
            let file = graph(Storage::Float32, radius);
            let errors = subject.judge(&gpu, &file, None).unwrap();
            (errors.surfaces.shading.leaking, errors.picture)
        });
        println!("{name}: {figures:?}");
        for pair in figures.windows(2) {
            let [(narrow, narrow_picture), (wide, wide_picture)] = pair else {
                panic!("not a pair")
            };
            assert!(wide > &(1.1 * narrow), "{name}");
            let [narrow, wide] = [narrow_picture, wide_picture].map(|p| p.penumbra.samples);
            assert!(wide as f64 > 1.05 * narrow as f64, "{name}");
        }
    }
}

#[test]
fn doubling_the_kernel_doubles_the_penumbra() {
    // Along the straight edges of a plate above the ground the penumbra is as wide as the kernel. It is not exactly twice
    // as wide: the lookup adds a texel to both, the ends of a kernel count for less than the penumbra's limits, and the
    // texels of a map with a wider margin are 3 % larger.
    let gpu = open();
    let mut ground = plate(30.0, 0.0);
    ground.ground = true;
    let mut scene = scene_of(vec![plate(1.0, 1.0), plate(0.02, 0.5), ground]);
    scene.stand = Some(Stand {
        eye: DVec3::new(0.0, 3.0, 4.0),
        target: DVec3::ZERO,
        light_direction: DVec3::new(0.1, -1.0, 0.05),
    });
    let [narrow, wide] = [4, 8].map(|radius| {
        let subject = subject(&gpu, &scene, &options(256, 4), radius);
        let file = graph(Storage::Float32, radius);
        let picture = subject.judge(&gpu, &file, None).unwrap().picture;
        picture.penumbra.samples as f64
    });
    println!("{narrow} and {wide} pixels");
    assert!(narrow > 500.0);
    assert!((wide / narrow - 2.0).abs() < 0.25, "{}", wide / narrow);
}
