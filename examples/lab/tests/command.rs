//! The command as a process: what a file says is drawn, outputs are checked before the work, and Ctrl-C ends it.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

const BINARY: &str = env!("CARGO_BIN_EXE_moment-shadows-lab");

/// The graph of hard shadows with other imports.
fn graph(folder: &Path, light: &str, camera: &str) -> PathBuf {
    let text = include_str!("../../hard_shadows.json");
    let with = |text: &str, name: &str, size: &str, desc: &str| {
        let start = text.find(&format!("\"name\": \"{name}\"")).unwrap();
        let texture = start + text[start..].find("{ \"format\"").unwrap();
        let end = texture + text[texture..].find('}').unwrap() + 1;
        assert!(text[texture..end].contains(size));
        format!("{}{desc}{}", &text[..texture], &text[end..])
    };
    let text = with(text, "light_depth", "1024", light);
    let text = with(&text, "camera_depth", "1280", camera);
    let path = folder.join("graph.json");
    fs::write(&path, text).unwrap();
    path
}

fn run(arguments: &[&str]) -> Output {
    Command::new(BINARY).args(arguments).output().unwrap()
}

fn texts(output: &Output) -> (String, String) {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (text(&output.stdout), text(&output.stderr))
}

fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.collect();
    names.sort();
    names
}

#[test]
fn what_a_file_says_of_its_imports_is_drawn() {
    let folder = tempfile::tempdir().unwrap();
    let light = r#"{ "format": "depth16unorm", "size": [96, 64], "samples": 1 }"#;
    let camera = r#"{ "format": "depth24plus", "size": [120, 80], "samples": 4 }"#;
    let graph = graph(folder.path(), light, camera);
    let graph = graph.to_str().unwrap();
    let of_file = "map 96x64 of depth16unorm with 1 sample per texel, picture 120x80 from depth24plus with 4 samples per pixel";
    let of_flags = "map 32x32 of depth16unorm with 4 samples per texel, picture 64x36 from depth24plus with 4 samples per pixel";
    let flags = ["--map", "32", "--samples", "4", "--width", "64"];
    let out = folder.path().join("out.png");
    for (given, expected) in [(&[][..], of_file), (&flags, of_flags)] {
        let render = ["render", "--graph", graph, "--out", out.to_str().unwrap()];
        let (_, said) = texts(&run(&[&render, given].concat()));
        assert!(said.contains(expected), "{said}");
        let picture = image::open(&out).unwrap();
        assert!(expected.contains(&format!("picture {}x{}", picture.width(), picture.height())));

        let measure = [
            "measure",
            "--graph",
            graph,
            "--storage",
            "float16",
            "--scene",
            "hall",
        ];
        let (table, said) = texts(&run(&[&measure, given].concat()));
        assert!(said.contains(expected), "{said}");
        let rows: Vec<&str> = table.lines().skip(1).collect();
        assert_eq!(rows.len(), 1, "{table}");
        assert!(rows[0].contains("float16"), "{table}");

        let error = ["error", "--graph", graph, "--scene", "hall"];
        let (report, _) = texts(&run(&[&error, given].concat()));
        assert!(report.contains(expected), "{report}");
    }
    let cost = ["cost", graph, "--rounds", "9"];
    let (_, said) = texts(&run(&cost));
    assert!(said.contains(of_file), "{said}");
}

#[test]
fn what_cannot_be_drawn_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let camera = r#"{ "format": "depth32float", "size": [64, 36] }"#;
    for (light, expected) in [
        (
            r#"{ "format": "depth32float", "size": [64, 64], "regions": 4 }"#,
            "import 'light_depth' has 4 regions",
        ),
        (
            r#"{ "format": "depth32float", "size": [64, 64], "layers": 6 }"#,
            "import 'light_depth' has 6 layers",
        ),
        (
            r#"{ "format": "r32float", "size": [64, 64] }"#,
            "use a depth format",
        ),
    ] {
        let graph = graph(folder.path(), light, camera);
        let out = folder.path().join("out.png");
        let arguments = [
            "render",
            "--graph",
            graph.to_str().unwrap(),
            "--out",
            out.to_str().unwrap(),
        ];
        let output = run(&arguments);
        let (_, said) = texts(&output);
        assert!(
            !output.status.success() && said.contains(expected),
            "{said}"
        );
        assert!(!out.exists());
    }
}

#[test]
fn an_output_that_cannot_be_written_is_refused_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let camera = r#"{ "format": "depth32float", "size": [64, 36] }"#;
    let light = r#"{ "format": "depth32float", "size": [64, 64] }"#;
    let graph = graph(folder.path(), light, camera);
    let graph = graph.to_str().unwrap();
    fs::create_dir(folder.path().join("folder.png")).unwrap();
    for (out, expected) in [
        ("missing/out.png", "does not exist"),
        ("folder.png", "it is a folder"),
        ("out.gif", ".png, .jpg or .jpeg"),
        ("out", ".png, .jpg or .jpeg"),
    ] {
        let out = folder.path().join(out);
        // What would be found later, if work was done first.
        let scene = ["--scene", "no such scene"];
        let render = ["render", "--graph", graph, "--out", out.to_str().unwrap()];
        let output = run(&[&render[..], &scene].concat());
        let (_, said) = texts(&output);
        assert_eq!(output.status.code(), Some(1));
        assert!(said.contains(expected), "{said}");
    }
    assert_eq!(files(folder.path()), ["folder.png", "graph.json"]);
}

#[test]
fn the_ending_is_what_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let camera = r#"{ "format": "depth32float", "size": [64, 36] }"#;
    let light = r#"{ "format": "depth32float", "size": [64, 64] }"#;
    let graph = graph(folder.path(), light, camera);
    for (ending, magic) in [("png", &b"\x89PNG"[..]), ("jpg", &b"\xff\xd8\xff"[..])] {
        let out = folder.path().join(format!("out.{ending}"));
        let arguments = [
            "render",
            "--graph",
            graph.to_str().unwrap(),
            "--truth",
            "--out",
            out.to_str().unwrap(),
        ];
        let output = run(&arguments);
        assert!(output.status.success(), "{:?}", texts(&output));
        for name in ["out", "out-truth", "out-shadow", "out-difference"] {
            let bytes = fs::read(folder.path().join(format!("{name}.{ending}"))).unwrap();
            assert!(bytes.starts_with(magic), "{name}.{ending}");
        }
    }
}

#[test]
fn wrong_arguments_are_named_and_negative_numbers_are_numbers() {
    for (arguments, expected) in [
        (&["render", "--view", "-1"][..], "invalid value '-1'"),
        (
            &[
                "scattering-error",
                "hall",
                "--elevation",
                "-91.5",
                "--view",
                "-2",
            ],
            "invalid value '-2'",
        ),
        (&["mesure"], "'measure'"),
        (&["measure", "--storge", "x"], "'--storage'"),
        (
            &["error", "--graph", "g", "--storage", "float61"],
            "'float16'",
        ),
    ] {
        let output = run(arguments);
        let (_, said) = texts(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(expected), "{said}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_ends_it_within_a_second() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.png");
    let graph = concat!(env!("CARGO_MANIFEST_DIR"), "/../hard_shadows.json");
    // What a process starts in the background may ignore the signal.
    for ignored in ["", "trap '' INT; "] {
        let command = format!(
            "{ignored}exec '{BINARY}' render --graph '{graph}' --scene hall --map 4096 --width 3840 --truth --out '{}'",
            out.display()
        );
        let mut child = Command::new("sh").arg("-c").arg(command).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(1500));
        assert_eq!(child.try_wait().unwrap(), None, "it has ended by itself");
        let mut kill = Command::new("kill");
        kill.args(["-INT", &child.id().to_string()]);
        assert!(kill.status().unwrap().success());
        let since = Instant::now();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if since.elapsed() > Duration::from_secs(20) {
                child.kill().unwrap();
                panic!("it went on");
            }
            std::thread::sleep(Duration::from_millis(5));
        };
        println!("ended after {:?}", since.elapsed());
        assert!(
            since.elapsed() < Duration::from_secs(1),
            "{:?}",
            since.elapsed()
        );
        assert_eq!(status.code(), Some(130));
        assert_eq!(files(folder.path()), Vec::<String>::new());
    }
}

#[test]
fn an_output_that_is_not_read_to_its_end_is_no_panic() {
    let graph = concat!(env!("CARGO_MANIFEST_DIR"), "/../hard_shadows.json");
    let mut command = Command::new(BINARY);
    command.args(["graph", graph, "--plan", "--json"]);
    let piped = std::process::Stdio::piped;
    let mut child = command.stdout(piped()).stderr(piped()).spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    let (_, said) = texts(&output);
    assert_eq!((output.status.code(), said.as_str()), (Some(141), ""));
}

/// A pair that is soon tried, with several chunks of inputs.
const PAIR: &str = "stability --technique vsm --storage float16 --inputs 2000000";

#[test]
fn a_stability_run_that_was_killed_gives_the_same_report_when_resumed() {
    let [killed, whole] = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let on = |folder: &Path, more: &[&str]| {
        let mut command = Command::new(BINARY);
        command.args(PAIR.split_whitespace()).args(more);
        command.arg("--out").arg(folder);
        command.stdout(std::process::Stdio::null());
        command
    };
    let mut child = on(killed.path(), &[]).spawn().unwrap();
    while files(killed.path()) != ["unfinished.json"] {
        assert_eq!(child.try_wait().unwrap(), None, "it has ended by itself");
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    for (more, expected) in [
        (&[][..], "--resume goes on with it"),
        (
            &["--resume", "--seed", "2"],
            "the seed was 1 and is 2; remove it to begin anew",
        ),
    ] {
        let (_, said) = texts(&on(killed.path(), more).output().unwrap());
        assert!(said.contains(expected), "{said}");
    }
    assert!(on(killed.path(), &["--resume"]).status().unwrap().success());
    assert!(on(whole.path(), &[]).status().unwrap().success());
    assert_eq!(files(killed.path()), files(whole.path()));
    let report = |folder: &Path| fs::read_to_string(folder.join("stability.json")).unwrap();
    assert_eq!(report(killed.path()), report(whole.path()));
}
