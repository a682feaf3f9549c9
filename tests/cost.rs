//! The logic of the cost harness. Times themselves are never asserted.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;

use moment_shadows::{DepthConversion, Profile, Storage};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::nodes::KernelProperty;
use moment_shadows_graph::record::{Passes, RecordError};
use moment_shadows_lab::command::cost;
use moment_shadows_lab::cost::CostError;
use moment_shadows_lab::cost::baseline::{Copies, CopyWork};
use moment_shadows_lab::cost::blur::{BOUNDS, BlurredMap, Bound};
use moment_shadows_lab::cost::clock::{Clock, ClockKind, FEATURES};
use moment_shadows_lab::cost::protocol::{FEWEST_ROUNDS, Rounds, Subject};
use moment_shadows_lab::cost::reference;
use moment_shadows_lab::cost::report::{BlurRow, Time};
use moment_shadows_lab::cost::statistics::Distribution;
use moment_shadows_lab::cost::texels::{decode, encode, noise, step};
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::DepthSamples;

fn time(median: f64, interquartile_range: f64) -> Time {
    let figure = Distribution {
        median,
        interquartile_range,
    };
    Time {
        x_shader_copy: figure,
        x_interface_copy: figure,
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

#[test]
fn a_gate_holds_on_software_adapters_alone() {
    let bound = Bound {
        radius: 4,
        gate: Some(4.5),
        goal: Some(3.4),
    };
    assert!(BlurRow::new(bound, time(4.5, 0.1), 0.0, true).passed());
    assert!(!BlurRow::new(bound, time(4.51, 0.1), 0.0, true).passed());
    assert!(!BlurRow::new(bound, time(f64::NAN, 0.1), 0.0, true).passed());
    assert!(BlurRow::new(bound, time(100.0, 0.1), 0.0, false).passed());
    let gates: Vec<_> = BOUNDS
        .iter()
        .map(|bound| (bound.radius, bound.gate))
        .collect();
    assert_eq!(
        gates,
        [
            (4, Some(4.5)),
            (12, Some(8.0)),
            (32, None),
            (64, Some(24.0))
        ]
    );
}

#[test]
fn texels_survive_encoding_within_half_a_step() {
    for storage in Storage::ALL {
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
    assert_eq!(
        reference::check("it", &output, &reference, 0.01).unwrap(),
        0.0
    );
    output[1][3] += 0.02;
    let refused = reference::check("it", &output, &reference, 0.01).unwrap_err();
    assert!(
        matches!(&refused, CostError::WrongResult { what, error, .. } if what == "it" && *error > 0.019),
        "{refused}"
    );
    // A NaN alone, and one before a finite difference.
    let mut nan = reference;
    nan[1][0] = f64::NAN;
    let mut among = output;
    among[1][2] = f64::NAN;
    for output in [&nan[..], &among[..], &reference[..1]] {
        let refused = reference::check("it", output, &reference, 0.01).unwrap_err();
        assert!(
            matches!(refused, CostError::WrongResult { .. }),
            "{refused}"
        );
    }
}

#[test]
fn every_subject_is_recorded_in_every_round_after_a_warm_up() {
    use std::cell::Cell;
    let gpu = Gpu::open(Profile::Native).unwrap();
    let desc = TextureDesc::new(Storage::Unorm16.format(), [512, 512]);
    let copies = Copies::new(&gpu, &desc, CopyWork::Compute).unwrap();
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
    let time = rounds.time(1, [0, 0]);
    assert!(time.seconds.median > 0.0);
    assert_eq!(rounds.time(0, [0, 0]).x_shader_copy.median, 1.0);
}

#[test]
fn timestamps_and_the_wall_give_times_too() {
    let gpu = Gpu::open_with(Profile::Native, FEATURES).unwrap();
    let desc = TextureDesc::new(Storage::Float32.format(), [256, 256]);
    let copies = Copies::new(&gpu, &desc, CopyWork::Compute).unwrap();
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
    assert!(Copies::new(&gpu, &desc, CopyWork::Fullscreen).is_ok());
    let refused = Copies::new(&gpu, &desc, CopyWork::Compute).err().unwrap();
    assert!(
        matches!(&refused, CostError::Baseline { format, .. } if *format == desc.format),
        "{refused}"
    );
}

/// Every pass of the example is found right where there is a reference, and its bytes are those of its textures.
#[test]
fn the_example_graph_is_checked_and_its_bytes_are_counted() {
    let graph = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json");
    let cost = cost::graph(&graph, 256, FEWEST_ROUNDS).unwrap();
    let rows: Vec<_> = cost
        .passes
        .iter()
        .map(|pass| (pass.pass.as_str(), pass.copy, pass.error.is_some()))
        .collect();
    assert_eq!(
        rows,
        [
            ("resolve/resolve", CopyWork::Compute, true),
            ("blur/blur along x", CopyWork::Compute, true),
            ("blur/blur along y", CopyWork::Compute, true),
            ("shade/shade", CopyWork::Fullscreen, false),
        ]
    );
    // 4 samples of 4 bytes and the parameters are read, 8 bytes are written; the blur reads and writes 8 bytes.
    let texels = 256 * 256;
    assert_eq!(cost.passes[0].bytes_written, 8 * texels);
    assert!(cost.passes[0].bytes_read >= 16 * texels);
    // And the map's one region of 16 bytes.
    assert_eq!(cost.passes[1].bytes_read, 8 * texels + 16);
    assert_eq!(cost.passes[1].minimum_bytes, 16 * texels + 16);
    let moved: u64 = cost.passes.iter().map(|pass| pass.minimum_bytes).sum();
    assert_eq!(cost.bytes_moved, moved);
    let json = serde_json::to_value(&cost).unwrap();
    assert!(json["conditions"]["adapter"].is_string(), "{json}");
    assert!(cost.to_string().contains("resident"), "{cost}");
}

/// One direction of a blur alone leaves the other undone; a number beyond the plan's passes is refused.
#[test]
fn passes_are_recorded_one_by_one() {
    let gpu = Gpu::open(Profile::Native).unwrap();
    let storage = Storage::Unorm16;
    let channels = noise(storage, 64 * 64);
    let kernel = KernelProperty::gaussian(4, 2.4);
    let map = BlurredMap::new(&gpu, storage, [64, 64], &channels, kernel, false).unwrap();
    let zeros = vec![[0.0; 4]; 64 * 64];
    let after = |passes: Passes<'_>| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        map.record_passes(passes, &mut encoder).unwrap();
        gpu.queue.submit([encoder.finish()]);
        map.read(&gpu).unwrap()
    };
    assert_eq!(after(Passes::Only(&[])), zeros);
    assert_eq!(after(Passes::Only(&[0])), zeros);
    let second = after(Passes::Only(&[1]));
    assert_ne!(second, zeros);
    assert_eq!(after(Passes::All), second);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let refused = map
        .record_passes(Passes::Only(&[0, 2]), &mut encoder)
        .unwrap_err();
    assert!(
        matches!(
            refused,
            CostError::Record(RecordError::NoSuchPassNumber { pass: 2, count: 2 })
        ),
        "{refused}"
    );
}
