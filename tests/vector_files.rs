//! Files of vectors that are wrong, and what the report says of vectors that the shader cannot match.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::{Path, PathBuf};

use moment_shadows_lab::vectors::{self, VectorFileError, VectorReport, VectorsError};
use serde_json::{Value, json};

/// The first published vector, alone in a file, as `change` leaves it.
fn changed(change: impl FnOnce(&mut Value)) -> (tempfile::TempDir, PathBuf) {
    let published = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors/moment_problem.json");
    let text = std::fs::read_to_string(published).unwrap();
    let mut vectors: Value = serde_json::from_str(&text).unwrap();
    let mut vector = vectors["vectors"][0].take();
    change(&mut vector);
    file(&json!({ "vectors": [vector] }).to_string())
}

fn file(text: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("vectors.json");
    std::fs::write(&path, text).unwrap();
    (folder, path)
}

fn run(change: impl FnOnce(&mut Value)) -> Result<VectorReport, VectorsError> {
    let (_folder, path) = changed(change);
    vectors::run(path)
}

/// What the report says is wrong with the changed vector.
fn reason(change: impl FnOnce(&mut Value)) -> String {
    let error = run(change).unwrap_err();
    let VectorsError::File(VectorFileError::Vector {
        index: 0,
        id,
        reason,
        ..
    }) = &error
    else {
        panic!("{error:?}");
    };
    assert!(error.to_string().contains("vectors.json") && error.to_string().contains(id));
    reason.clone()
}

#[test]
fn a_missing_file_is_named() {
    let error = vectors::run("no/such/vectors.json").unwrap_err();
    assert!(matches!(
        error,
        VectorsError::File(VectorFileError::Unreadable { .. })
    ));
    assert!(error.to_string().contains("no/such/vectors.json"));
}

#[test]
fn text_that_is_no_file_of_vectors_is_refused_with_its_position() {
    for text in ["", "{", "[]", "{}", "{\"vectors\": 3}", "\u{0}"] {
        let (_folder, path) = file(text);
        let error = vectors::run(path).unwrap_err();
        assert!(matches!(
            error,
            VectorsError::File(VectorFileError::Malformed { .. })
        ));
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
