//! Files of vectors that are wrong, and what the report says of vectors that the shader cannot match.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

use moment_shadows_lab::error::LabError;
use moment_shadows_lab::vectors::{self, VectorReport};
use serde_json::{Value, json};

/// The first published vector, alone in a file, as `change` leaves it.
fn changed(change: impl FnOnce(&mut Value)) -> (tempfile::TempDir, PathBuf) {
    changed_of(4, change)
}

/// The first published vector with `count` moments, alone in a file, as `change` leaves it.
fn changed_of(count: usize, change: impl FnOnce(&mut Value)) -> (tempfile::TempDir, PathBuf) {
    let published = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors/moment_problem.json");
    let text = std::fs::read_to_string(published).unwrap();
    let vectors: Value = serde_json::from_str(&text).unwrap();
    let mut vectors = vectors["vectors"].as_array().unwrap().iter();
    let mut vector = vectors.find(|vector| vector["m"] == count).unwrap().clone();
    change(&mut vector);
    file(&json!({ "vectors": [vector] }).to_string())
}

fn file(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("vectors.json");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn run(change: impl FnOnce(&mut Value)) -> Result<VectorReport, LabError> {
    let (_folder, path) = changed(change);
    vectors::run(path)
}

/// What the report says is wrong with the changed vector.
fn reason(change: impl FnOnce(&mut Value)) -> String {
    let error = run(change).unwrap_err();
    let LabError::Unsuitable { file, reason } = error else {
        panic!("{error:?}");
    };
    assert!(file.contains("vectors.json, vector 0 ('"), "{file}");
    reason
}

#[test]
fn a_missing_file_is_named() {
    let error = vectors::run("no/such/vectors.json").unwrap_err();
    assert!(matches!(error, LabError::Unsuitable { .. }));
    assert!(error.to_string().contains("no/such/vectors.json"));
}

#[test]
fn text_that_is_no_file_of_vectors_is_refused_with_its_position() {
    for text in ["", "{", "[]", "{}", "{\"vectors\": 3}", "\u{0}"] {
        let (_folder, path) = file(text);
        let error = vectors::run(path).unwrap_err();
        assert!(matches!(error, LabError::Unsuitable { .. }));
        assert!(error.to_string().contains("line"), "{error}");
    }
}

#[test]
fn a_wrong_vector_is_named_with_what_is_wrong() {
    assert!(reason(|vector| vector["class"] = json!(3)).contains("expected a string"));
    assert!(reason(|vector| vector["m"] = json!(3)).contains("m is 3"));
    assert!(reason(|vector| vector["moments_f32"] = json!([0.5])).contains("moments_f32 has 1"));
    assert!(reason(|vector| vector["depth"] = json!(0.1)).contains("depth 0.1"));
    let hex = reason(|vector| vector["biased"][1]["input_hex"][2] = json!("0x7fc00000"));
    assert!(hex.contains("biased[1]") && hex.contains("0x7fc00000"));
    assert!(reason(|vector| vector["biased"][0]["alpha"] = json!(0.0)).contains("alpha is 0"));
}

#[test]
fn a_bound_that_the_shader_does_not_reach_fails_its_class() {
    // Ten units of the tolerance are beyond 8 and within 32, a hundred are beyond both.
    for (units, far_beyond) in [(10.0, 0), (100.0, 1)] {
        let report = run(|vector| {
            let record = &mut vector["biased"][0];
            let unit = record["tol"][1].as_f64().unwrap() / 8.0;
            let upper = record["hamburger"]["upper"].as_f64().unwrap();
            record["hamburger"]["upper"] = json!(upper + units * unit);
        })
        .unwrap();
        assert!(!report.passed());
        let class = &report.biased["generic3"];
        assert_eq!([class.beyond, class.far_beyond], [1, far_beyond]);
        assert!(class.largest > 0.9 * units);
        assert!(report.to_string().ends_with("FAILED"));
    }
}

#[test]
fn so_does_a_hausdorff_bound() {
    // Its unit is at least 2^-24 and, for this vector, below 3 of them: the file's tolerances are those of Hamburger bounds.
    for (steps, far_beyond) in [(0.0, 0), (30.0, 0), (1000.0, 1)] {
        let report = run(|vector| {
            let bound = &mut vector["biased"][1]["hausdorff"]["upper"];
            *bound = json!(bound.as_f64().unwrap() + steps * 2f64.powi(-24));
        })
        .unwrap();
        assert_eq!(report.passed(), steps == 0.0);
        let class = &report.biased["generic3, Hausdorff"];
        let beyond = usize::from(steps > 0.0);
        assert_eq!([class.beyond, class.far_beyond], [beyond, far_beyond]);
        // The Hamburger bounds of the same record are as they were.
        assert_eq!(report.biased["generic3"].beyond, 0);
    }
}

#[test]
fn two_moments_are_evaluated_without_and_with_a_bias_of_the_files() {
    for (steps, far_beyond) in [(0.0, 0), (1000.0, 1)] {
        let (_folder, path) = changed_of(2, |vector| {
            let hex =
                |moment: &Value| format!("{:#010x}", (moment.as_f64().unwrap() as f32).to_bits());
            let moments = vector["moments_f32"].as_array().unwrap();
            // The exact moments are within 2^-25 of these, and so are the bounds but for their sensitivity.
            let input: Vec<String> = moments.iter().map(hex).collect();
            let lower = vector["hamburger"]["lower"].as_f64().unwrap() + steps * 2f64.powi(-24);
            vector["biased"] = json!([{
                "for": "float32", "depth_kind": "as_given", "depth": vector["depth"], "alpha": 1e-6,
                "input_hex": input, "hamburger": { "lower": lower, "upper": 1.0 },
                "hausdorff": null, "sens": null, "tol": null
            }]);
        });
        let report = vectors::run(path).unwrap();
        let class = &report.biased["generic2, 2 moments"];
        assert_eq!([class.evaluated, class.far_beyond], [1, far_beyond]);
        // Once for the smallest variance of each storage.
        let class = &report.unbiased["generic2, 2 moments"];
        assert_eq!([class.evaluated, class.beyond], [3, 0]);
        // The oracle is compared with the changed bound, too, which is that of the unrounded moments.
        let reasons: Vec<_> = report.not_evaluated.iter().collect();
        assert!(
            matches!(&reasons[..], [(reason, 2)] if reason.contains("Hausdorff bounds of 2 moments")),
            "{reasons:?}"
        );
    }
}

#[test]
fn hausdorff_records_that_no_f32_solver_matches_are_named() {
    let report = run(|vector| {
        // A fragment behind the range, and moments on the boundary of those on [-1, 1]: of both ends, half each.
        vector["biased"][0]["depth"] = json!(1.5);
        vector["biased"][1]["input_hex"] =
            json!(["0x00000000", "0x3f800000", "0x00000000", "0x3f800000"]);
        vector["interval"] = json!([-1.0, 1.0]);
    })
    .unwrap();
    for expected in ["outside of the interval", "no digit of the second pivot"] {
        let found = report
            .not_evaluated
            .iter()
            .filter(|(reason, _)| reason.contains(expected))
            .map(|(_, count)| count);
        assert_eq!(found.sum::<usize>(), 1, "{expected}: {report}");
    }
    let report = run(|vector| vector["interval"] = json!([0.0, 1.0])).unwrap();
    assert!(
        report
            .biased
            .keys()
            .chain(report.unbiased.keys())
            .all(|class| !class.contains("Hausdorff"))
    );
}

#[test]
fn records_that_cannot_be_compared_are_counted_with_the_reason() {
    let report = run(|vector| {
        vector["biased"][0]["hamburger"] = json!({ "lower": null, "upper": null });
        vector["biased"][1]["hamburger"] = Value::Null;
        // Without a tolerance the sensitivity serves, without both the oracle's.
        vector["biased"][2]["tol"] = Value::Null;
        vector["biased"][3]["tol"] = json!([null, null]);
        vector["biased"][3]["sens"] = Value::Null;
    })
    .unwrap();
    assert!(report.passed());
    assert_eq!(report.biased["generic3"].evaluated, 3);
    let reasons: Vec<_> = report.not_evaluated.iter().collect();
    assert!(
        reasons
            .iter()
            .any(|(reason, count)| reason.contains("the file gives none") && **count == 2),
        "{reasons:?}"
    );
}

#[test]
fn a_file_without_anything_to_evaluate_does_not_pass() {
    let (_folder, path) = file("{\"vectors\": []}");
    assert!(!vectors::run(path).unwrap().passed());
}
