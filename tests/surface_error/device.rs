//! What the processor peels and evaluates against what the device draws.

use glam::DVec2;
use moment_shadows::{MapEncoding, Profile, ReceiverBias, Storage, Technique};
use moment_shadows_lab::candidate::Candidate;
use moment_shadows_lab::command::render::LightChoice;
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::shade_parameters;
use moment_shadows_lab::host::read_depth_samples;
use moment_shadows_lab::scene;
use moment_shadows_lab::surface_error::{Evaluation, MapEvaluator, MapPoint, MapRun};
use moment_shadows_lab::techniques::{self, label};
use moment_shadows_lab::truth::fragment::fragments;
use moment_shadows_lab::truth::peel::Peeler;

use crate::setup::{frame, graph, open, options, subject};

/// The share of the texels whose centre has been peeled in which the first surface is not what the device's map of one
/// sample holds.
fn disagreement(name: &str, light: LightChoice) -> f64 {
    let gpu = open();
    let scene = scene::load(name).unwrap();
    let mut options = options(256, 1);
    options.light = light;
    let file = graph(Storage::Float32, 4);
    let drawn = options.drawn(&file).unwrap();
    let frame = options.frame(&gpu, &scene, &drawn, 4).unwrap();
    let light = &frame.desc.light;
    let stored = read_depth_samples(&gpu, &frame.light_map.texture).unwrap();
    let map = frame.desc.map;
    let surfaces = Peeler::new(&scene, light, map).unwrap().rows(0..map[1]);
    // Casters are closed, or have two fronts: what the light sees first of them is a front.
    let of_casters = surfaces
        .iter()
        .filter(|surface| surface.layer == 0 && !surface.ground);
    let [fronts, all] = of_casters.fold([0, 0], |[fronts, all], surface| {
        [fronts + u32::from(surface.faces_light), all + 1]
    });
    println!("{name}: {fronts} fronts of {all} surfaces");
    assert!(
        f64::from(fronts) > 0.99 * f64::from(all),
        "{name}: {fronts} of {all}"
    );
    let mut first = vec![(1.0, 0.0); stored.values.len()];
    for surface in surfaces.iter().filter(|surface| surface.layer == 0) {
        let [x, y] = surface.texel;
        let per_distance = 2.0 / (light.range[1] - light.range[0]);
        first[(y * map[0] + x) as usize] = (
            light
                .moment_depth_of_distance(surface.distance)
                .clamp(-1.0, 1.0),
            surface.distance_per_texel() * per_distance,
        );
    }
    let disagree = stored
        .values
        .iter()
        .zip(first)
        .filter(|&(&stored, (depth, slope))| {
            // Vertices move by up to half a step of 1/256 texel, twice that along a slope between two of them; on top of it
            // eight roundings to f32 of numbers up to 2.
            let tolerance = slope / 256.0 + 8.0 * 2.0 / f64::from(1 << 24);
            (light.moment_depth_of_stored(f64::from(stored)) - depth).abs() > tolerance
        });
    disagree.count() as f64 / f64::from(map[0] * map[1])
}

#[test]
fn the_first_surfaces_are_those_of_the_device_s_map() {
    for light in [LightChoice::Sun, LightChoice::Spot] {
        // Triangles that the device has moved by 1/512 texel own other centres along their edges: of a texel with an edge
        // across it, in one of a few hundred.
        let hall = disagreement("hall", light);
        println!("hall {light:?}: {hall:.6}");
        assert!(hall < 1e-3, "{light:?}: {hall}");
        // Leaves end where a linear filter says, whose weights devices round to 1/256.
        let leaves = disagreement("fence-and-foliage", light);
        println!("fence-and-foliage {light:?}: {leaves:.6}");
        assert!(leaves < 2e-3, "{light:?}: {leaves}");
    }
}

/// Where the node looks the map up for each pixel it shades, at its depth less the bias, and what it gives there.
fn shaded_points(frame: &Frame, run: &MapRun, gpu: &Gpu) -> (Vec<MapPoint>, Vec<f32>) {
    let shaded = run.graph.read_shadow(gpu, &run.file).unwrap();
    let camera_depth = read_depth_samples(gpu, &frame.surface.depth).unwrap();
    let parameters = shade_parameters(&frame.desc, &run.file).unwrap();
    let lookups = fragments(&parameters, &camera_depth, frame.desc.map);
    lookups
        .iter()
        .zip(shaded)
        .filter_map(|(lookup, shaded)| {
            let lookup = (*lookup)?;
            let uv = DVec2::from_array(lookup.uv);
            let point = MapPoint::new(uv, lookup.fragment_depth, DVec2::ZERO);
            Some((point, shaded))
        })
        .unzip()
}

/// How far apart two lists are, ascending.
fn differences(found: &[f32], shaded: &[f32]) -> Vec<f32> {
    let pairs = found.iter().zip(shaded);
    let mut differences: Vec<f32> = pairs.map(|(a, b)| (a - b).abs()).collect();
    differences.sort_by(f32::total_cmp);
    differences
}

#[test]
fn points_are_evaluated_as_by_shade_hard() {
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let scene = scene::load("hall").unwrap();
    let frame = frame(&gpu, &scene, (256, 4), 4);
    let placed = |encoding: &MapEncoding| {
        let lloyd = techniques::variant(encoding.technique())?;
        let lloyd = MapEncoding::new(lloyd, encoding.storage()).ok()?;
        lloyd.technique().row().places_layers.then_some(lloyd)
    };
    let mut encodings = techniques::filterable();
    encodings.extend(encodings.iter().find_map(placed));
    for encoding in encodings {
        let candidate = Candidate::Filterable(encoding.clone());
        let file = candidate.graph(&graph(Storage::Float32, 4)).unwrap();
        let run = MapRun::new(&gpu, &frame, &file).unwrap();
        let map = run.map(&frame).unwrap();
        let is_placed = encoding.technique().row().places_layers;
        assert_eq!(map.desc.encoding != Some(encoding.clone()), is_placed);
        let (points, shaded) = shaded_points(&frame, &run, &gpu);
        assert!(points.len() > 20_000);
        let evaluation = Evaluation {
            receiver_bias: ReceiverBias::NONE,
            ..run.shading
        };
        let evaluator = MapEvaluator::new(&gpu, &map, None).unwrap();
        let found = evaluator.run(evaluation, &points).unwrap();
        let apart = differences(&found, &shaded);
        let at = |share: f64| apart[(share * (apart.len() - 1) as f64) as usize];
        println!(
            "{} as {}: {} points, 95 % {}, 99 % {}, maximum {}",
            label(encoding.technique()),
            encoding.storage(),
            points.len(),
            at(0.95),
            at(0.99),
            at(1.0)
        );
        // The node computes places and depths in f32 where these are rounded from f64: about 1e-6 of depth. At the
        // steepest that is 1e-3 of intensity for four moments (next to a surface, within the reach sqrt(alpha) of the least
        // bias), and 1e-4 for an exponent of 80. Places off by 1e-7 of the map are 2.6e-5 texels, across which a
        // filtered map changes by as much of itself.
        assert!(at(0.99) < 1e-3, "{encoding}: {}", at(0.99));
        // A gradient and a bias instead of a depth that has it already: the same to a rounding.
        let slope = 0.015625;
        let biased = Evaluation {
            receiver_bias: ReceiverBias {
                constant: 0.0,
                slope_scale: 2.0,
                maximum: 1.0,
                ..ReceiverBias::NONE
            },
            ..evaluation
        };
        let moved: Vec<MapPoint> = points
            .iter()
            .map(|point| MapPoint {
                moment_depth: point.moment_depth.min(0.9) + 2.0 * slope,
                gradient: [0.6 * slope, -0.8 * slope],
                ..*point
            })
            .collect();
        let plain: Vec<MapPoint> = points
            .iter()
            .map(|point| MapPoint {
                moment_depth: point.moment_depth.min(0.9),
                ..*point
            })
            .collect();
        let moved = evaluator.run(biased, &moved).unwrap();
        let plain = evaluator.run(evaluation, &plain).unwrap();
        let apart = moved
            .iter()
            .zip(&plain)
            .filter(|(a, b)| (**a - **b).abs() > 1e-3);
        assert!(apart.count() < points.len() / 100, "{encoding}");
    }
}

#[test]
fn percentage_closer_filtering_has_hardly_an_error_on_the_truth_s_own_map() {
    // One sample per texel and the same kernel: both compare the same samples with the same plane.
    let gpu = open();
    let scene = scene::load("hall").unwrap();
    let subject = subject(&gpu, &scene, &options(256, 1), 4);
    let judge = |candidate: Candidate| {
        let file = candidate.graph(&graph(Storage::Float32, 4)).unwrap();
        subject.judge(&gpu, &file, None).unwrap()
    };
    let filtered = judge(Candidate::PercentageCloser);
    let binary = judge(Candidate::ReadingDepth(Technique::Binary));
    for errors in [&filtered, &binary] {
        println!("{:?} {:?}", errors.technique, errors.surfaces);
        assert_eq!((errors.storage, errors.bits_per_texel), (None, 32));
        assert_eq!(errors.surfaces.nan, 0);
    }
    let filtered = filtered.surfaces;
    println!("{filtered:?}");
    // Leak reduction takes 0.98 for full shadow: penumbrae are too dark by up to 2 % of themselves.
    assert!(filtered.shading.mean_absolute < 0.01);
    // What the truth has in front of a plane, so has the shader, but for the constant 3e-5 of depth that it takes off.
    assert!(filtered.shading.leaking < 1e-4);
    // At a surface's own depth nothing is taken off; the truth takes no surface for its own occluder.
    assert!(filtered.distribution.leaking < 1e-6);
    // One texel does not make a kernel.
    assert!(binary.surfaces.shading.mean_absolute > 5.0 * filtered.shading.mean_absolute);
}
