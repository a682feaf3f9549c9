//! The stability report, on a few pairs.

use moment_shadows::{MapEncoding, Profile, Storage, Technique};
use moment_shadows_lab::command::stability::pairs;
use moment_shadows_lab::error::LabError;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::stability::report::Report;
use moment_shadows_lab::stability::{Effort, Progress, run};

fn report(pairs: &[MapEncoding], effort: Effort) -> Report {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let none = Progress::none(pairs.len());
    run(&gpu, pairs, effort, none, |_| Ok(()), |_| {}).unwrap()
}

#[test]
fn a_quick_report_of_two_pairs_finds_no_fault() {
    let pairs = [
        MapEncoding::new(Technique::Hamburger4, Storage::Unorm16).unwrap(),
        MapEncoding::new(Technique::Vsm, Storage::Float16).unwrap(),
    ];
    let report = report(&pairs, Effort::QUICK);
    println!("{report}");
    assert_eq!(report.faults(), 0);
    for row in &report.rows {
        // 200 climbs of 20 steps with four tries each.
        assert!(row.samples >= Effort::QUICK.inputs + 200 * 20 * 4);
        // The inputs are hard: there is some excess, though it is allowed, and some leaking, though it is not all.
        assert!(row.excess.drawn > 0.1 * row.excess.allowed);
        assert!((0.05..0.3).contains(&row.mean_leak));
    }
}

#[test]
fn six_moments_have_no_fault_in_any_storage() {
    let pairs = pairs(Some("hamburger6"), None).unwrap();
    assert_eq!(pairs.len(), 4);
    let report = report(&pairs, Effort::QUICK);
    println!("{report}");
    assert_eq!(report.faults(), 0);
    // They leak less than four moments do.
    for row in &report.rows {
        assert!(row.mean_leak < 0.15);
    }
}

#[test]
fn the_same_seed_gives_the_same_report_and_another_one_another() {
    let pairs = pairs(Some("convolution"), Some("unorm8")).unwrap();
    let effort = |seed| Effort {
        inputs: 2000,
        steps: 3,
        seed,
    };
    let reports = [1, 1, 2].map(|seed| report(&pairs, effort(seed)));
    assert_eq!(reports[0], reports[1]);
    assert_ne!(reports[0].rows, reports[2].rows);
}

#[test]
fn a_run_in_two_halves_gives_the_report_of_one() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let pairs = pairs(Some("vsm"), None).unwrap();
    // Two chunks, the second one not full.
    let effort = Effort {
        inputs: 500_000,
        steps: 3,
        seed: 1,
    };
    let mut half = None;
    let stopped = run(
        &gpu,
        &pairs,
        effort,
        Progress::none(pairs.len()),
        |progress| {
            half = Some(progress.clone());
            Err(LabError::refused("stopped"))
        },
        |_| {},
    );
    assert_eq!(stopped.unwrap_err().to_string(), "stopped");
    let resumed = run(&gpu, &pairs, effort, half.unwrap(), |_| Ok(()), |_| {}).unwrap();
    assert_eq!(resumed, report(&pairs, effort));
}

#[test]
fn a_pair_that_does_not_exist_is_refused_with_those_that_do() {
    let error = pairs(Some("evsm2"), Some("unorm16")).unwrap_err();
    let text = error.to_string();
    assert_eq!(
        text,
        "evsm2: it is not stored as unorm16; it is as float16 or float32"
    );
}
