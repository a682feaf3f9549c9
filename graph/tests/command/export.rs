//! `moment-shadows export` as a process.

use std::fs;

use moment_shadows::{MapEncoding, Storage, Target, Technique, Vectors};

use super::{names, run};

fn export(technique: &str, storage: &str, further: &[&str]) -> (Option<i32>, String, String) {
    let arguments = ["export", "--technique", technique, "--storage", storage];
    run(&[&arguments, further].concat())
}

#[test]
fn functions_are_printed_or_written_with_vectors_beside_them() {
    let folder = tempfile::tempdir().unwrap();
    let encoding = MapEncoding::new(Technique::Vsm, Storage::Unorm16).unwrap();
    for target in Target::ALL {
        let expected = moment_shadows::export(&encoding, target).unwrap();
        let (code, printed, said) = export("vsm", "unorm16", &["--target", target.name()]);
        assert_eq!((code, said.as_str()), (Some(0), ""));
        assert_eq!(printed, expected.text);

        let into = ["--target", target.name(), "--out"];
        let out = folder.path().join(target.name()).with_extension("own");
        for (out, file) in [
            (&out, out.clone()),
            (
                &folder.path().to_owned(),
                folder
                    .path()
                    .join(format!("vsm_unorm16.{}", target.extension())),
            ),
        ] {
            let (code, printed, said) = export(
                "vsm",
                "unorm16",
                &[&into[..], &[out.to_str().unwrap()]].concat(),
            );
            assert_eq!((code, printed.as_str(), said.as_str()), (Some(0), "", ""));
            assert_eq!(fs::read_to_string(&file).unwrap(), expected.text);
            let vectors = fs::read_to_string(file.with_extension("vectors.json")).unwrap();
            let read: Vectors = serde_json::from_str(&vectors).unwrap();
            assert_eq!(read, expected.vectors().unwrap());
            // A row on each line.
            let rows: usize = read.functions.iter().map(|it| it.rows.len()).sum();
            assert_eq!(
                vectors
                    .lines()
                    .filter(|it| it.starts_with("{\"inputs\""))
                    .count(),
                rows
            );
        }
    }
}

#[test]
fn settings_are_those_of_graph_files() {
    let given = export(
        r#"{"esm": {"exponent": 20.0}}"#,
        "float32",
        &["--target", "glsl"],
    );
    assert_eq!(given.0, Some(0), "{}", given.2);
    assert!(
        given.1.contains("const float EXPONENT = 20.0;"),
        "{}",
        given.1
    );
    let usual = export("esm", "float32", &["--target", "glsl"]);
    assert!(
        usual.1.contains("const float EXPONENT = 80.0;"),
        "{}",
        usual.1
    );
}

#[test]
fn what_cannot_be_exported_is_refused_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().display();
    let (json, missing) = (format!("{here}/h.json"), format!("{here}/no/h.hlsl"));
    let hlsl = ["--target", "hlsl"];
    let hamburger = |out: &'static str| export("hamburger4", "float16", &["--target", out]);
    for (given, code, expected) in [
        (
            export("pcf", "float16", &hlsl),
            1,
            "'pcf' reads the plain depth map",
        ),
        (
            export("vsm", "unorm8", &hlsl),
            1,
            "it can as unorm16 or float32 or float16",
        ),
        (
            export("hamburger4", "fixed32", &hlsl),
            1,
            "cannot be stored as fixed32",
        ),
        (
            export(r#"{"evsm2": {"exponent": 50.0}}"#, "float32", &hlsl),
            1,
            "it is from 1 to 40",
        ),
        (
            export(
                r#"{"lvsm": {"layers": 2, "splits": "lloyd"}}"#,
                "float16",
                &hlsl,
            ),
            1,
            "export it with splits that are given",
        ),
        (export("hamburger", "float16", &hlsl), 2, "hamburger4"),
        (export(r#"{"vsm": "#, "float16", &hlsl), 2, "--technique"),
        (
            export("vsm", "half", &hlsl),
            2,
            "[possible values: unorm16, float16",
        ),
        (
            hamburger("cg"),
            2,
            "[possible values: hlsl, glsl, msl, wgsl]",
        ),
        (run(&["export", "--technique", "vsm"]), 2, "--storage"),
        (
            export("vsm", "float16", &["--target", "hlsl", "--out", &json]),
            1,
            "name it by its language",
        ),
        (
            export("vsm", "float16", &["--target", "hlsl", "--out", &missing]),
            1,
            "does not exist; create it first",
        ),
    ] {
        let (found, printed, said) = given;
        assert_eq!((found, printed.as_str()), (Some(code), ""), "{said}");
        assert!(said.contains(expected), "{expected}: {said}");
    }
    assert!(names(folder.path()).is_empty());
}
