//! The command as a process: what it prints, what it refuses, and its exit codes.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod ci;
mod export;
mod graph_file;
mod validate;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use moment_shadows::Profile;
use moment_shadows_graph::{Capabilities, Graph, Plan};

const GRAPH: &str = include_str!("../../../examples/hard_shadows.json");

fn command(arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_moment-shadows"));
    command.args(arguments);
    command
}

/// The exit code, what is printed, and what is said beside it.
fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    told(&command(arguments).output().unwrap())
}

fn told(output: &Output) -> (Option<i32>, String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let code = output.status.code();
    (code, text(&output.stdout), text(&output.stderr))
}

/// A new folder with these files, and their paths.
fn files<const COUNT: usize>(files: [(&str, &str); COUNT]) -> (tempfile::TempDir, [String; COUNT]) {
    let folder = tempfile::tempdir().unwrap();
    let paths = files.map(|(name, text)| {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, text).unwrap();
        path.display().to_string()
    });
    (folder, paths)
}

/// The plan that the library compiles.
fn plan(profile: Profile) -> Plan {
    let graph: Graph = GRAPH.parse().unwrap();
    let capabilities = Capabilities::of_profile(profile);
    graph.compile(&capabilities, &[]).unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn graphs_are_checked_and_printed() {
    let (_folder, [good, bad, old, huge]) = files([
        ("good.json", GRAPH),
        (
            "bad.json",
            &GRAPH.replace("\"type\": \"resolve\"", "\"type\": \"resolf\""),
        ),
        (
            "old.json",
            &GRAPH
                .replace("\"version\": 2", "\"version\": 1")
                .replace("\"type\": \"resolve\"", "\"type\": \"resolve_moments\""),
        ),
        ("huge.json", &" ".repeat((1 << 20) + 1)),
    ]);
    let (code, printed, said) = run(&["graph", &good]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    for line in [
        "import  light_depth",
        "node    resolve",
        "output  shadow_intensity",
    ] {
        assert!(printed.contains(line), "{printed}");
    }
    // Properties are printed as the file has them.
    assert!(
        printed.contains(r#"blur {"kernel":{"radius":"#),
        "{printed}"
    );

    let (code, whole, _) = run(&["graph", &good, "--plan"]);
    assert_eq!(code, Some(0));
    let expected = format!("{printed}\n{}\n", plan(Profile::Native));
    assert_eq!(whole, expected);

    let (code, json, _) = run(&[
        "graph",
        &good,
        "--plan",
        "--json",
        "--profile",
        "webgpu-core",
    ]);
    assert_eq!(code, Some(0));
    let read: Plan = serde_json::from_str(&json).unwrap();
    assert_eq!(read, plan(Profile::WebgpuCore));

    let (code, printed, said) = run(&["graph", &bad]);
    assert_eq!((code, printed.as_str()), (Some(1), ""));
    let place = format!("error: {bad}:");
    for expected in [&place, "there is no node type 'resolf'", "'resolve'"] {
        assert!(said.contains(expected), "{said}");
    }

    let (code, _, said) = run(&["graph", &old]);
    assert_eq!(code, Some(0));
    assert!(
        said.contains("'resolve_moments' is called 'resolve' now"),
        "{said}"
    );

    let (code, _, said) = run(&["graph", &huge]);
    assert_eq!(code, Some(1));
    assert!(said.contains("it is longer than 1048576 bytes"), "{said}");
    let (code, _, said) = run(&["graph", "missing.json"]);
    assert_eq!(code, Some(1));
    assert!(
        said.starts_with("error: 'missing.json' cannot be read: "),
        "{said}"
    );
}

#[test]
fn plans_are_exported_whole_or_not_at_all() {
    let (folder, [good, bad]) = files([("good.json", GRAPH), ("bad.json", "{")]);
    let (code, printed, said) = run(&["export-plan", &good]);
    assert_eq!((code, said.as_str()), (Some(0), ""));
    let read: Plan = serde_json::from_str(&printed).unwrap();
    assert_eq!(read, plan(Profile::Native));
    read.check().unwrap();

    let out = folder.path().join("plan.json");
    let to = out.to_str().unwrap();
    let core = ["--profile", "webgpu-core", "--out", to];
    let export = |file: &str| run(&[&["export-plan", file], &core[..]].concat());
    assert_eq!(export(&good), (Some(0), String::new(), String::new()));
    let written = fs::read_to_string(&out).unwrap();
    let read: Plan = serde_json::from_str(&written).unwrap();
    assert_eq!(read, plan(Profile::WebgpuCore));

    let (code, _, said) = export(&bad);
    assert_eq!(code, Some(1));
    assert!(said.starts_with(&format!("error: {bad}:1:")), "{said}");
    assert_eq!(fs::read_to_string(&out).unwrap(), written);

    fs::create_dir(folder.path().join("folder")).unwrap();
    for (out, expected) in [
        ("folder", "it is a folder"),
        ("no/plan.json", "does not exist"),
    ] {
        let out: PathBuf = folder.path().join(out);
        let (code, _, said) = run(&["export-plan", &good, "--out", out.to_str().unwrap()]);
        assert_eq!(code, Some(1));
        assert!(said.contains(expected), "{said}");
    }
    let expected = ["bad.json", "folder", "good.json", "plan.json"];
    assert_eq!(names(folder.path()), expected);
}

#[test]
fn plans_are_exported_for_sizes_groups_and_features() {
    // The description of the first import.
    let start = GRAPH.find(", \"texture\"").unwrap();
    let described = start..start + GRAPH[start..].find("} }").unwrap() + 1;
    let (_folder, [graph, open]) = files([
        ("graph.json", GRAPH),
        ("open.json", &GRAPH.replacen(&GRAPH[described], "", 1)),
    ]);
    let export = |options: &[&str]| {
        let (code, printed, said) = run(&[&["export-plan", &graph], options].concat());
        assert_eq!((code, said.as_str()), (Some(0), ""));
        serde_json::from_str::<Plan>(&printed).unwrap()
    };
    let plain = export(&[]);
    let name = plain.imports[0].name.clone();
    let sized = export(&["--size", &format!("{name}=640x352"), "--bind-group", "3"]);
    let size = |plan: &Plan| {
        plan.resources[plan.imports[0].value]
            .desc
            .texture()
            .unwrap()
            .size
    };
    assert_eq!((size(&sized), sized.bind_group), ([640, 352], 3));
    assert_ne!((size(&plain), plain.bind_group), ([640, 352], 3));
    assert!(
        sized
            .shaders
            .iter()
            .all(|text| text.contains("const GROUP = 3;"))
    );

    let compact = export(&["--compact"]);
    let bytes = |plan: &Plan| plan.shaders.iter().map(String::len).sum::<usize>();
    assert!(
        3 * bytes(&compact) < 2 * bytes(&plain),
        "{} of {}",
        bytes(&compact),
        bytes(&plain)
    );
    assert!(compact.shaders.iter().all(|text| !text.contains("//")));
    assert_eq!(
        Plan {
            shaders: plain.shaders.clone(),
            ..compact
        },
        plain
    );

    for (options, code, expected) in [
        (["--size", "light"], 2, "it is written NAME=WxH"),
        (["--size", "light=4x"], 2, "it is written NAME=WxH"),
        (["--size", "nothing=4x4"], 1, "there is no import 'nothing'"),
        (["--allow", "float32-filter"], 2, "'float32-filterable'"),
        (["--bind-group", "one"], 2, "--bind-group"),
    ] {
        let (found, printed, said) = run(&[&["export-plan", &graph][..], &options].concat());
        assert_eq!(
            (found, printed.as_str()),
            (Some(code), ""),
            "{options:?} {said}"
        );
        assert!(said.contains(expected), "{said}");
    }
    let size = format!("{name}=64x64");
    let (code, _, said) = run(&["export-plan", &graph, "--size", &size, "--size", &size]);
    assert_eq!(code, Some(1));
    assert!(said.contains("two sizes; leave one out"), "{said}");
    let (code, _, said) = run(&["export-plan", &open, "--size", &size]);
    assert_eq!(code, Some(1));
    assert!(said.contains("has no texture in the graph file"), "{said}");
}

#[cfg(feature = "wgpu")]
#[test]
fn the_adapter_is_printed_or_missed() {
    let (code, printed, said) = run(&["adapter"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(printed.contains("Vulkan") || printed.contains("Metal") || printed.contains("Dx12"));
    assert_eq!(printed.lines().count(), 1, "{printed}");

    // No driver at all.
    let mut without = command(&["adapter"]);
    let without = without.envs(["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].map(|name| (name, "none")));
    if cfg!(target_os = "linux") {
        let (code, printed, said) = told(&without.output().unwrap());
        assert_eq!((code, printed.as_str()), (Some(1), ""));
        assert!(
            said.contains("apt-get install mesa-vulkan-drivers"),
            "{said}"
        );
    }
}

#[cfg(not(feature = "wgpu"))]
#[test]
fn a_command_without_wgpu_says_how_to_get_one_with_it() {
    let (code, printed, said) = run(&["adapter"]);
    assert_eq!((code, printed.as_str()), (Some(1), ""));
    for expected in [
        "built without wgpu",
        "cargo install moment-shadows-graph --features cli",
    ] {
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn wrong_usage_names_what_is_near() {
    for (arguments, expected) in [
        (&[][..], "Usage: moment-shadows"),
        (&["validat"], "'validate'"),
        (&["export-plans", "g"], "'export-plan'"),
        (&["validate"], "<PATH>..."),
        (&["validate", "g", "--format", "sarife"], "'sarif'"),
        (&["validate", "g", "--allow", "f61"], "`f16`"),
        (&["validate", "g", "--profil", "native"], "'--profile'"),
        (&["graph", "g", "--profile", "nativ"], "'native'"),
        (&["graph", "g", "--json"], "--plan"),
    ] {
        let (code, printed, said) = run(arguments);
        assert_eq!((code, printed.as_str()), (Some(2), ""), "{said}");
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn the_help_has_the_exit_codes() {
    let (code, help, _) = run(&["--help"]);
    assert_eq!(code, Some(0));
    for expected in [
        "validate",
        "graph",
        "export-plan",
        "export ",
        "adapter",
        "Exit codes: 0 ",
        "1 ",
        "2 ",
    ] {
        assert!(help.contains(expected), "{help}");
    }
    let (code, version, _) = run(&["--version"]);
    let expected = concat!("moment-shadows ", env!("CARGO_PKG_VERSION"), "\n");
    assert_eq!((code, version.as_str()), (Some(0), expected));
}

#[cfg(unix)]
#[test]
fn an_output_that_is_not_read_to_its_end_is_no_failure_to_tell() {
    let (_folder, [graph]) = files([("graph.json", GRAPH)]);
    for arguments in [&["graph", &graph, "--plan"][..], &["export-plan", &graph]] {
        let mut command = command(arguments);
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let (code, _, said) = told(&child.wait_with_output().unwrap());
        assert_eq!((code, said.as_str()), (Some(141), ""));
    }
}
