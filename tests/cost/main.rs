//! The logic of the cost harness. Times themselves are never asserted.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod graph;
mod hard_shadows;
mod table;

use moment_shadows::{DepthConversion, Profile, Storage};
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::cost::clock::{Clock, ClockKind, FEATURES};
use moment_shadows_lab::cost::copies::{Copies, CopyWork};
use moment_shadows_lab::cost::harness::{Case, Measured};
use moment_shadows_lab::cost::protocol::{CopyNumbers, FEWEST_ROUNDS, Rounds, Subject};
use moment_shadows_lab::cost::reference;
use moment_shadows_lab::cost::report::Time;
use moment_shadows_lab::cost::scattering;
use moment_shadows_lab::cost::statistics::Distribution;
use moment_shadows_lab::cost::summed_area;
use moment_shadows_lab::cost::table::Gate;
use moment_shadows_lab::cost::texels::{decode, encode, noise, step};
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::DepthSamples;

fn time(median: f64, interquartile_range: f64) -> Time {
    let figure = Distribution {
        median,
        interquartile_range,
    };
    Time {
        x_compute_copy: figure,
        x_api_copy: figure,
        x_draw_copy: None,
        seconds: figure,
        wall: figure,
        reliable: figure.reliable(),
    }
}

#[test]
fn median_and_quartiles_interpolate_between_figures() {
    let odd = Distribution::of([5.0, 1.0, 3.0, 2.0, 4.0]);
    assert_eq!((odd.median, odd.interquartile_range), (3.0, 2.0));
    // Quartiles of 1 2 3 4 lie at 1.75 and 3.25.
    let even = Distribution::of([4.0, 1.0, 2.0, 3.0]);
    assert_eq!((even.median, even.interquartile_range), (2.5, 1.5));
    let outlier = Distribution::of([1.0, 1.0, 1.0, 1.0, 1000.0]);
    assert_eq!((outlier.median, outlier.interquartile_range), (1.0, 0.0));
}

#[test]
fn a_wide_spread_and_no_figures_are_unreliable() {
    assert!(time(2.0, 0.30).reliable);
    assert!(!time(2.0, 0.31).reliable);
    assert!(Distribution::of([]).median.is_nan());
    assert!(!Distribution::of([]).reliable());
}

/// Each list of subjects with what the rounding of its results may be: less would mean that nothing was compared.
#[test]
fn subjects_are_checked_and_those_that_a_device_would_choose_are_bounded() {
    let gpu = Gpu::open_with(Profile::Native, FEATURES).unwrap();
    let software = Capabilities::of_device(&gpu.adapter, &gpu.device).software_adapter;
    let growth = |gate, goal| Gate {
        gate,
        goal,
        largest_growth: Some(1.3),
    };
    let subjects = |cases: Vec<Case>, errors: std::ops::Range<f64>| -> Vec<(String, Gate)> {
        let subject = |case: Case| {
            let error = case.difference.unwrap().accepted(&case.name).unwrap();
            assert!(errors.contains(&error), "{}: {error}", case.name);
            (case.name, case.gate)
        };
        cases.into_iter().map(subject).collect()
    };
    let choice = |gate, chosen| if chosen { gate } else { Gate::default() };
    // Float16 rounds channels of up to 1/2 by up to 1.2e-4, weights of up to 1 by twice that.
    assert_eq!(
        subjects(scattering::cases(&gpu, 96).unwrap(), 1e-4..3.5e-4),
        [
            ("rectify".to_owned(), growth(None, None)),
            (
                "serial".to_owned(),
                choice(growth(Some(1.3), None), software)
            ),
            ("parallel".to_owned(), choice(growth(None, None), !software)),
        ]
    );
    let tables = (summed_area::TABLES.cases)(&gpu, 96).unwrap();
    // Sums are exact.
    assert_eq!(
        subjects(tables, 0.0..f64::MIN_POSITIVE),
        [
            (
                "software_tiles".to_owned(),
                choice(growth(Some(3.5), Some(2.3)), software)
            ),
            (
                "hardware_tiles".to_owned(),
                choice(growth(Some(3.5), Some(2.3)), !software)
            ),
            ("naive".to_owned(), Gate::default()),
        ]
    );
}

/// A case whose result is wrong is refused before it is timed, and rows say what JSON of earlier versions says.
#[test]
fn a_wrong_result_is_not_timed() {
    let gpu = Gpu::open_with(Profile::Native, FEATURES).unwrap();
    let clock = Clock::new(&gpu, ClockKind::ProcessTime);
    let mut cases = scattering::cases(&gpu, 64).unwrap();
    cases.truncate(1);
    let measured = Measured::of(&clock, &cases, 1, || ()).unwrap();
    // A map of four moments is read and both planes are written, 8 bytes each.
    assert!(measured.rows[0].bytes_per_texel >= 24.0);
    let json = serde_json::to_value(&measured.rows[0]).unwrap();
    assert_eq!(
        (&json["size"], &json["method"]),
        (&64.into(), &"rectify".into())
    );
    cases[0].difference.as_mut().unwrap().error = f64::NAN;
    cases[0].record = Box::new(|_| panic!("it is timed"));
    let refused = Measured::of(&clock, &cases, 1, || ()).err().unwrap();
    assert!(
        matches!(&refused, LabError::WrongResult { what, .. } if what == "rectify"),
        "{refused}"
    );
}

#[test]
fn a_difference_from_sums_in_f64_is_found() {
    let bytes = |values: [f32; 8]| -> Vec<u8> {
        let halves = values.map(|value| half::f16::from_f32(value).to_le_bytes());
        halves.concat()
    };
    let summed = bytes([0.5, 0.0, 0.25, -0.5, 0.25, 0.5, 0.25, 0.5]);
    // Weights 1 and 1/2: two thirds of the first texel and a third of the second.
    let thickness = [core::f64::consts::LN_2];
    let third = |first: f32, second: f32| (2.0 * first + second) / 3.0;
    let means = [third(0.5, 0.25), third(0.0, 0.5), 0.25, third(-0.5, 0.5)];
    let [a, b, c, d] = means;
    let found = |d: f32| bytes([0.5, 0.0, 0.25, -0.5, a, b, c, d]);
    let error = |found: &[u8]| scattering::reference::sums_error(found, &summed, &thickness);
    assert!(error(&found(d)) < 1.3e-4);
    assert!((error(&found(d + 0.125)) - 0.125).abs() < 2e-4);
    assert!(error(&found(f32::NAN)).is_nan());
    assert!(error(&[]).is_nan());
}

#[test]
fn texels_survive_encoding_within_half_a_step() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let channels = noise(storage, 1000);
        let stored = decode(storage, &encode(storage, &channels));
        assert_eq!(stored.len(), channels.len());
        for (stored, given) in stored.iter().flatten().zip(channels.iter().flatten()) {
            // The smallest excess is for the decimal 1/65535.
            assert!(
                (stored - given).abs() <= 0.5001 * step(storage),
                "{storage}"
            );
        }
    }
}

#[test]
fn the_resolve_reference_averages_moments_not_depths() {
    // A near and a far sample: the mean of the depths is 0, but the second moment is 1.
    let depth = DepthSamples {
        width: 1,
        height: 1,
        samples: 2,
        values: vec![0.0, 1.0],
    };
    let orthographic = DepthConversion::orthographic();
    let raw = reference::resolve(&depth, &orthographic, Storage::Float32);
    assert_eq!(raw, [[0.0, 1.0, 0.0, 1.0]]);
    // The optimised basis maps them to (1/2, 0, 1/2, 1).
    let unorm = reference::resolve(&depth, &orthographic, Storage::Unorm16);
    assert_eq!(unorm, [[0.5, 0.0, 0.5, 1.0]]);
    let float = reference::resolve(&depth, &orthographic, Storage::Float16);
    assert_eq!(float, [[0.0, -0.5, 0.0, 0.5]]);
}

#[test]
fn a_wrong_or_nan_or_short_output_is_refused() {
    let reference = [[0.25; 4], [0.5; 4]];
    let mut output = reference;
    let accepted =
        |output: &[[f64; 4]]| reference::difference(output, &reference, 0.01).accepted("it");
    assert_eq!(accepted(&output).unwrap(), 0.0);
    output[1][3] += 0.02;
    let refused = accepted(&output).unwrap_err();
    assert!(
        matches!(&refused, LabError::WrongResult { what, error, .. } if what == "it" && *error > 0.019),
        "{refused}"
    );
    // A NaN alone, and one before a finite difference.
    let mut nan = reference;
    nan[1][0] = f64::NAN;
    let mut among = output;
    among[1][2] = f64::NAN;
    for output in [&nan[..], &among[..], &reference[..1]] {
        let refused = accepted(output).unwrap_err();
        assert!(
            matches!(refused, LabError::WrongResult { error, .. } if error.is_nan()),
            "{refused}"
        );
    }
}

#[test]
fn every_subject_is_recorded_in_every_round_after_a_warm_up() {
    use std::cell::Cell;
    let gpu = Gpu::open(Profile::Native).unwrap();
    let desc = TextureDesc::new(Storage::Unorm16.format(), [512, 512]);
    let copies = Copies::new(&gpu, std::slice::from_ref(&desc), CopyWork::Compute).unwrap();
    let [counted, ended] = [Cell::new(0), Cell::new(0)];
    let subjects = [
        Subject {
            name: "copy".to_owned(),
            record: copies.by_shader(),
        },
        Subject {
            name: "counted copy".to_owned(),
            record: Box::new(|encoder| {
                counted.set(counted.get() + 1);
                copies.by_shader()(encoder)
            }),
        },
    ];
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let rounds = Rounds::run(&clock, &subjects, 1, || ended.set(ended.get() + 1)).unwrap();
    assert_eq!(ended.get(), FEWEST_ROUNDS);
    assert!(counted.get() > FEWEST_ROUNDS, "{}", counted.get());
    let copies = CopyNumbers {
        compute: 0,
        api: 1,
        draw: None,
    };
    let time = rounds.time(&[(0, copies)]);
    assert!(time.seconds.median > 0.0);
    assert_eq!(time.x_compute_copy.median, 1.0);
    // In each round the two ratios are each other's inverse, and the sum of both subjects is one more than either.
    let inverse = rounds.ratio(&[1], &[0]);
    assert_eq!(rounds.time(&[(1, copies)]).x_compute_copy, inverse);
    let both = rounds.time(&[(0, copies), (1, copies)]);
    let one_more = rounds.ratio(&[0, 1], &[0]);
    // Up to the rounding of sums.
    assert!((2.0 * both.x_compute_copy.median - one_more.median).abs() < 1e-12);
    assert!((one_more.median - 1.0 - inverse.median).abs() < 1e-12);
    assert_eq!(both.x_draw_copy, None);
}

#[test]
fn timestamps_and_the_wall_give_times_too() {
    let gpu = Gpu::open_with(Profile::Native, FEATURES).unwrap();
    let desc = TextureDesc::new(Storage::Float32.format(), [256, 256]);
    let copies = Copies::new(&gpu, std::slice::from_ref(&desc), CopyWork::Compute).unwrap();
    let mut kinds = vec![ClockKind::Wall, ClockKind::ProcessTime];
    if gpu.device.features().contains(FEATURES) {
        kinds.push(ClockKind::Timestamps);
    }
    for kind in kinds {
        let clock = Clock::new(&gpu, kind);
        let reading = clock
            .time("copy", |encoder| copies.by_shader()(encoder))
            .unwrap();
        assert!(
            reading.seconds.is_finite() && reading.seconds >= 0.0,
            "{kind:?}"
        );
        assert!(reading.wall > 0.0, "{kind:?}");
    }
}

#[test]
fn a_format_that_cannot_be_copied_is_an_error() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let desc = TextureDesc::new(moment_shadows::TextureFormat::R8Unorm, [64, 64]);
    assert!(Copies::new(&gpu, std::slice::from_ref(&desc), CopyWork::Fullscreen).is_ok());
    let refused = Copies::new(&gpu, std::slice::from_ref(&desc), CopyWork::Compute)
        .err()
        .unwrap();
    assert!(
        matches!(&refused, LabError::Unsuitable { file, .. } if *file == desc.format.to_string()),
        "{refused}"
    );
}

/// Three texels become one, and five become two of two and a half each.
#[test]
fn the_downsample_reference_covers_every_texel_once() {
    let row: Vec<[f64; 4]> = [1.0, 2.0, 3.0, 4.0, 10.0].map(|value| [value; 4]).to_vec();
    assert_eq!(reference::downsample(&row[..3], [3, 1], [1, 1]).len(), 1);
    let third = reference::downsample(&row[..3], [1, 3], [1, 1])[0][0];
    assert!((third - 2.0).abs() < 1e-12, "{third}");
    let halves = reference::downsample(&row, [5, 1], [2, 1]);
    let wanted = [(1.0 + 2.0 + 1.5) / 2.5, (1.5 + 4.0 + 10.0) / 2.5];
    for (found, wanted) in halves.iter().zip(wanted) {
        assert!((found[2] - wanted).abs() < 1e-12, "{found:?}");
    }
}

/// Layered textures are copied layer by layer, and the device accepts it.
#[test]
fn copies_have_the_layers_of_their_texture() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let desc = TextureDesc {
        layers: 3,
        ..TextureDesc::new(Storage::Float16.format(), [64, 64])
    };
    for work in [CopyWork::Compute, CopyWork::Fullscreen] {
        let copies = Copies::new(&gpu, std::slice::from_ref(&desc), work).unwrap();
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        copies.by_shader()(&mut encoder).unwrap();
        copies.by_interface()(&mut encoder).unwrap();
        gpu.queue.submit([encoder.finish()]);
        gpu.check().unwrap();
    }
}
