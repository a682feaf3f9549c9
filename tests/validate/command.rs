//! The command: files, exit codes, modules of the library.

use crate::storing;
use moment_shadows::{Profile, ValidationReport, modules};
use moment_shadows_graph::command::CommandError;
use moment_shadows_graph::command::validate::{check_file, run};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

#[test]
fn the_command_checks_files() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path
    };
    let good = write(
        "good.wgsl",
        b"import moment_shadows::maths::hankel::{hankel_factor};\nfn f() {}\n",
    );
    let bad = write(
        "bad.wgsl",
        b"import moment_shadows::maths::hankel::{hankel_factor};\nfn f( {}\n",
    );
    let norm = write("norm.wgsl", storing("rgba16unorm", "write").as_bytes());
    let binary = write("binary.wgsl", &[0xff, 0xfe, 0x00]);
    let long = write(
        "long.wgsl",
        &vec![b' '; ValidationReport::LONGEST_SHADER + 1],
    );
    let missing = folder.path().join("missing.wgsl");

    check_file(&good, Profile::WebgpuCore).unwrap();
    let error = check_file(&bad, Profile::WebgpuCore).unwrap_err();
    let at = format!("--> {}:2:7", bad.display());
    assert!(error.to_string().contains(&at), "{error}");
    for path in [&binary, &long, &missing, &folder.path().to_owned()] {
        match check_file(path, Profile::WebgpuCore).unwrap_err() {
            CommandError::Read { path: named, .. } => assert_eq!(named, path.display().to_string()),
            other => panic!("another error: {other}"),
        }
    }

    let code = |code: ExitCode| format!("{code:?}");
    let run = |files: &[PathBuf], profile| run(files, profile).unwrap();
    let (success, failure) = (code(ExitCode::SUCCESS), code(ExitCode::FAILURE));
    assert_eq!(code(run(std::slice::from_ref(&good), None)), success);
    assert_eq!(code(run(&[bad, good.clone()], None)), failure);
    assert_eq!(code(run(&[missing, good], None)), failure);
    assert_eq!(code(run(std::slice::from_ref(&norm), None)), failure);
    assert_eq!(code(run(&[norm], Some(Profile::Native))), success);
}

#[test]
fn the_command_checks_modules_of_the_library() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("wgsl");
    for module in modules() {
        let path = root
            .join(module.folder)
            .join(format!("{}.wgsl", module.name));
        check_file(&path, Profile::WebgpuCore).unwrap_or_else(|error| panic!("{error}"));
    }
}
