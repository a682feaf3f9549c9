//! Light leaking where thin legs meet the ground.

use moment_shadows::{Profile, Storage, Technique};
use moment_shadows_lab::candidate::{Candidate, TechniqueChoice};
use moment_shadows_lab::contacts::{BAND, Contacts};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::shade_parameters;
use moment_shadows_lab::scene::{self, feet};
use moment_shadows_lab::surface_error::MapPoint;
use moment_shadows_lab::truth::exact_bound::biased_bound;
use moment_shadows_lab::truth::lookup::Lookup;
use moment_shadows_lab::truth::pcf::Receiver;
use moment_shadows_lab::truth::peel::Peeler;

use crate::setup::{frame, graph, open, options};

const RADIUS: u32 = 4;

fn contacts(gpu: &Gpu) -> Contacts {
    Contacts::new(gpu, &options(512, 4), &graph(Storage::Float32, RADIUS)).unwrap()
}

#[test]
fn every_leg_stands_on_the_ground() {
    let scene = scene::load("chairs").unwrap();
    let feet = feet(&scene);
    assert_eq!(feet.len(), 6 * 4);
    for foot in &feet {
        assert!(foot.centre.y.abs() < 1e-6, "{foot:?}");
        // The half diagonal of 24 mm.
        assert!(
            (foot.radius - 0.012 * 2.0_f64.sqrt()).abs() < 1e-5,
            "{foot:?}"
        );
    }
    // No two bands overlap.
    for (index, one) in feet.iter().enumerate() {
        for other in &feet[index + 1..] {
            assert!(one.centre.distance(other.centre) > 2.0 * (one.radius + BAND));
        }
    }
}

#[test]
fn points_of_planes_are_what_is_peeled_of_them() {
    let gpu = open();
    let scene = scene::load("chairs").unwrap();
    let frame = frame(&gpu, &scene, (64, 1), 4);
    let (light, map) = (&frame.desc.light, frame.desc.map);
    let per_distance = 2.0 / (light.range[1] - light.range[0]);
    let surfaces = Peeler::new(&scene, light, map).unwrap().rows(0..map[1]);
    assert!(surfaces.len() > 64 * 64);
    for surface in surfaces {
        let receiver = Receiver {
            position: surface.position,
            normal: surface.normal,
        };
        let point = MapPoint::of_plane(light, map, &receiver);
        let place = surface.texel.map(|at| (at as f32 + 0.5) / 64.0);
        let gradient = surface.distance_gradient * per_distance;
        // Seen almost edge-on, both are quotients of small numbers; the bias is limited long before.
        if gradient.length() > 1.0 {
            continue;
        }
        for axis in 0..2 {
            assert!((point.uv[axis] - place[axis]).abs() < 1e-6);
            let apart = f64::from(point.gradient[axis]) - gradient[axis];
            assert!(apart.abs() < 1e-5, "{point:?} {surface:?}");
        }
    }
}

#[test]
fn four_moments_leak_at_contacts_as_little_as_their_bound_allows() {
    // Two moments in half precision are a format that not every native device writes.
    let gpu = Gpu::open(Profile::NativeAdapter).unwrap();
    let contacts = contacts(&gpu);
    let judge = |name: &str, storage: Storage| {
        let choice: TechniqueChoice = name.parse().unwrap();
        let candidate = choice.in_storage(Some(storage)).unwrap();
        let file = candidate.graph(&graph(storage, RADIUS)).unwrap();
        let found = contacts.judge(&gpu, &contacts.frame, &file).unwrap();
        println!("{name} {storage}: {found:?}");
        found
    };
    // The exact bound of the biased moments, in f64, at the fragments of the shader.
    let file = graph(Storage::Float32, RADIUS);
    let parameters = shade_parameters(&contacts.frame.desc, &file).unwrap();
    let bias = parameters.receiver_bias;
    let lookups: Vec<Option<Lookup>> = contacts
        .points
        .iter()
        .map(|point| {
            let [x, y] = point.gradient.map(f64::from);
            let slope = f64::from(bias.slope_scale) * x.hypot(y) + f64::from(bias.constant);
            Some(Lookup {
                uv: point.uv.map(f64::from),
                fragment_depth: f64::from(point.moment_depth).min(1.0)
                    - slope.min(f64::from(bias.maximum)),
            })
        })
        .collect();
    let full_shadow = parameters.leak_reduction.full_shadow;
    let mut leaks = Vec::new();
    for storage in Storage::OF_FOUR_MOMENTS {
        let (depths, taps) = (&contacts.unfiltered.depths, &contacts.unfiltered.taps);
        let bound = biased_bound(depths, taps, &lookups, storage.moment_bias());
        let leaking: f64 = bound
            .iter()
            .zip(&contacts.truth)
            .map(|(bound, truth)| f64::from(truth - (bound / full_shadow).min(1.0)).max(0.0))
            .sum();
        let least = leaking / bound.len() as f64;
        let hamburger = judge("hamburger4", storage);
        println!("at least {least}");
        // No technique that knows these moments leaks less, and this one hardly more: what rounding in storage adds goes
        // either way, and is at most half a percent of the error elsewhere, too.
        assert!(
            (hamburger.leaking / least - 1.0).abs() < 5e-3,
            "{storage}: {} of {least}",
            hamburger.leaking
        );
        // Two of the same moments leave more open.
        assert!(
            hamburger.leaking < judge("vsm", storage).leaking,
            "{storage}"
        );
        leaks.push(hamburger.leaking);
    }
    let [unorm16, float16, float32] = leaks[..] else {
        panic!("three storages")
    };
    assert!(float32 < unorm16 && unorm16 < float16);
    // A third of the band is in shadow, and some of that in full shadow.
    let one = judge("hamburger4", Storage::Unorm16);
    assert!(
        one.truth > 0.1 && one.points_in_full_shadow > 100,
        "{one:?}"
    );
    assert!(one.leaking < one.truth);
}

#[test]
fn percentage_closer_filtering_does_not_leak_at_contacts() {
    let gpu = open();
    let contacts = contacts(&gpu);
    let chairs = scene::load("chairs").unwrap();
    let plain = frame(&gpu, &chairs, (512, 1), RADIUS);
    let candidate = Candidate::PercentageCloser;
    let file = candidate.graph(&graph(Storage::Float32, RADIUS)).unwrap();
    let found = contacts.judge(&gpu, &plain, &file).unwrap();
    println!("{found:?}");
    assert!(matches!(found.technique, Technique::Pcf(_)));
    // One sample stands for four: along an edge of the leg it is all or nothing of a texel, a ninth of the kernel's width.
    assert!(found.leaking < 0.01, "{}", found.leaking);
    assert!(found.leaking_in_full_shadow < 0.01);
}
