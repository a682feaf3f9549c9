//! Modules that are edited without a build: read from a folder in debug builds, never in release builds.

use std::env;
use std::fs;
use std::process::{Command, Output};

use moment_shadows::modules;

use crate::link_user;

const VARIABLE: &str = "MOMENT_SHADOWS_WGSL";

/// What the other tests run in a process of its own: prints a shader with one module, twice linked.
#[test]
#[ignore = "run by the other tests, in an environment of their own"]
fn prints_what_is_linked() {
    let text = "import moment_shadows::maths::angle::{ANGLE_EDITED};\nconst a = ANGLE_EDITED;\n";
    assert_eq!(modules().as_ptr(), modules().as_ptr());
    match link_user(text) {
        Ok(linked) => println!("{}", linked.wgsl()),
        Err(error) => println!("{error}"),
    }
}

fn run(folder: &str) -> String {
    let Output { stdout, .. } = Command::new(env::current_exe().unwrap())
        .args([
            "--ignored",
            "--exact",
            "--nocapture",
            "edited::prints_what_is_linked",
        ])
        .env(VARIABLE, folder)
        .output()
        .unwrap();
    String::from_utf8(stdout).unwrap()
}

#[test]
fn a_debug_build_reads_the_folder_and_a_release_build_does_not() {
    let folder = env::temp_dir().join(format!("moment_shadows_edited_{}", std::process::id()));
    fs::create_dir_all(folder.join("maths")).unwrap();
    fs::write(folder.join("maths/angle.wgsl"), "const ANGLE_EDITED = 7;\n").unwrap();
    let shown = run(folder.to_str().unwrap());
    fs::remove_dir_all(&folder).unwrap();
    assert_eq!(
        shown.contains("const ANGLE_EDITED = 7;"),
        cfg!(debug_assertions),
        "{shown}"
    );
    assert!(shown.contains("1 passed"), "{shown}");
}

#[test]
fn a_folder_that_does_not_exist_is_named() {
    let shown = run("/there/is/no/such/folder");
    let expected = "MOMENT_SHADOWS_WGSL names /there/is/no/such/folder, which is no folder";
    assert_eq!(shown.contains(expected), cfg!(debug_assertions), "{shown}");
    assert!(shown.contains("1 passed"), "{shown}");
}
