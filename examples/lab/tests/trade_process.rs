//! The commands `trade` and `choose` as processes: bad input, no adapter, a full disk, and Ctrl-C, after which they go on.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::sync::LazyLock;
#[cfg(unix)]
use std::time::{Duration, Instant};

use serde_json::Value;

const BINARY: &str = env!("CARGO_BIN_EXE_moment-shadows-lab");

/// The file of what was found, until all is.
const JOURNAL: &str = "unfinished.jsonl";

/// What is traded: five rows.
const SMALL: &str =
    "fence-and-foliage --quick --map 128 --samples 1 --views 2 --technique vsm hamburger4 --out";

fn output(arguments: &str, more: &[&str]) -> Output {
    let arguments = arguments.split_whitespace().chain(more.iter().copied());
    Command::new(BINARY).args(arguments).output().unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Runs a trade to its end.
fn trade(folder: &Path) -> Vec<Value> {
    let output = output(&format!("trade {SMALL}"), &[folder.to_str().unwrap()]);
    assert!(output.status.success(), "{}", said(&output));
    rows(folder)
}

/// The rows of a finished trade.
fn rows(folder: &Path) -> Vec<Value> {
    assert!(!folder.join(JOURNAL).exists());
    assert!(folder.join("report.html").is_file());
    let results = fs::read_to_string(folder.join("results.json")).unwrap();
    let results: Value = serde_json::from_str(&results).unwrap();
    results["scenes"][0]["rows"].as_array().unwrap().clone()
}

/// The rows of a trade that was stopped, all of whose files are given; its last line may be torn.
fn unfinished(folder: &Path) -> Vec<Value> {
    let files = fs::read_dir(folder).unwrap();
    let files: Vec<_> = files.map(|file| file.unwrap().file_name()).collect();
    assert_eq!(files, [JOURNAL]);
    let journal = fs::read_to_string(folder.join(JOURNAL)).unwrap();
    let end = journal.rfind('\n').unwrap();
    let lines = journal[..end].lines().skip(1);
    let findings = lines.map(|line| serde_json::from_str::<Value>(line).unwrap());
    let mut findings: Vec<Value> = findings.collect();
    findings.retain(|finding| finding["found"] == "row");
    findings
        .iter()
        .map(|finding| finding["row"].clone())
        .collect()
}

/// A trade that was stopped goes on: what it had found is kept with its times, and errors are those of one that was not.
fn assert_goes_on(folder: &Path) {
    static UNDISTURBED: LazyLock<Vec<Value>> =
        LazyLock::new(|| trade(tempfile::tempdir().unwrap().path()));
    let undisturbed = &*UNDISTURBED;
    let before = unfinished(folder);
    assert!(!before.is_empty() && before.len() < undisturbed.len());
    let after = trade(folder);
    assert_eq!(after[..before.len()], before);
    assert_eq!(after.len(), undisturbed.len());
    for (row, other) in after.iter().zip(undisturbed) {
        for field in [
            "candidate",
            "map",
            "samples",
            "name",
            "views",
            "bytes_resident",
        ] {
            assert_eq!(row[field], other[field], "{field} of {}", row["name"]);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_trade_that_was_interrupted_goes_on() {
    let stopped = tempfile::tempdir().unwrap();
    let mut command = Command::new(BINARY);
    command.arg("trade").args(SMALL.split_whitespace());
    let mut child = command.arg(stopped.path()).spawn().unwrap();
    let journal = stopped.path().join(JOURNAL);
    let found = || fs::read_to_string(&journal).unwrap_or_default();
    while !found().contains("\"found\":\"row\"") {
        assert_eq!(child.try_wait().unwrap(), None, "it has ended by itself");
        std::thread::sleep(Duration::from_millis(5));
    }
    let mut kill = Command::new("kill");
    kill.args(["-INT", &child.id().to_string()]);
    assert!(kill.status().unwrap().success());
    let since = Instant::now();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    let took = since.elapsed();
    assert!(took < Duration::from_secs(1), "{took:?}");
    assert_goes_on(stopped.path());
}

/// A limit on the size of files stands in for a disk that is full: writes fail alike, and nobody's disk has to be.
#[cfg(unix)]
#[test]
fn a_full_disk_is_named_and_what_was_found_is_kept() {
    let full = tempfile::tempdir().unwrap();
    // In blocks of 512 or 1024 bytes, as the shell has it: one or two rows with their pictures.
    let limited = format!(
        "trap '' XFSZ; ulimit -f 110; MESA_SHADER_CACHE_DISABLE=true exec '{BINARY}' trade {SMALL} '{}'",
        full.path().display()
    );
    let output = Command::new("sh").arg("-c").arg(limited).output().unwrap();
    let said = said(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for expected in [JOURNAL, "File too large", "the same folder to go on"] {
        assert!(said.contains(expected), "{said}");
    }
    // Not even a torn line.
    assert!(
        fs::read_to_string(full.path().join(JOURNAL))
            .unwrap()
            .ends_with('\n')
    );
    assert_goes_on(full.path());
}

/// Results stand for a finished trade, so they come last.
#[test]
fn without_its_page_a_trade_is_not_finished() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("report.html");
    fs::create_dir(&page).unwrap();
    let trade = || {
        output(
            "trade hall --quick --map 64 --samples 1 --views 1 --technique pcf --out",
            &[folder.path().to_str().unwrap()],
        )
    };
    let stopped = trade();
    let said = said(&stopped);
    assert_eq!(stopped.status.code(), Some(1), "{said}");
    assert!(said.contains("report.html"), "{said}");
    assert!(!folder.path().join("results.json").exists());
    fs::remove_dir(&page).unwrap();
    assert!(trade().status.success());
    assert_eq!(rows(folder.path()).len(), 1);
}

#[cfg(target_os = "linux")]
#[test]
fn an_output_that_cannot_be_written_is_said() {
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let mut command = Command::new(BINARY);
    command.args(["probe", "hall", "--quick", "--map", "64", "--views", "1"]);
    let output = command.stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("No space left"), "{}", said(&output));
}

#[test]
fn what_cannot_be_traded_is_named_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    for (arguments, code, expected) in [
        ("trade --out", 2, "<SCENE>..."),
        ("trade hall --technique hamburger5 --out", 2, "hamburger4"),
        ("trade hall --profile webgpu-cores --out", 2, "webgpu-core"),
        ("trade hall --jobs hard,sofd --out", 2, "soft"),
        ("trade hall --views 0 --out", 2, "--views"),
        ("trade hal --quick --out", 1, "there is no file 'hal'"),
        (
            "trade hall --quick --map 64 --radius 64 --out",
            1,
            "choose a larger map or a smaller margin",
        ),
        ("choose hall --quick --out", 2, "--max-error"),
        (
            "choose hall --quick --max-error 0 --out",
            2,
            "give a number above 0",
        ),
        (
            "choose hall --quick --max-time nan --out",
            2,
            "give a number above 0",
        ),
        (
            "choose hall --quick --max-bytes 1.5 --out",
            2,
            "--max-bytes",
        ),
    ] {
        let output = output(arguments, &[out]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(code), "{arguments}: {said}");
        assert!(said.contains(expected), "{arguments}: {said}");
    }
}

/// The nearest is printed, no graph is written, and the exit code says so.
#[test]
fn a_bound_that_nothing_keeps_to_has_a_code_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let graph = folder.path().join("graph.json");
    let choose = "choose fence-and-foliage --quick --map 64 --views 2 --technique vsm pcf --max-error 0.0001 --max-bytes 1";
    let output = output(
        choose,
        &[
            "--out",
            folder.path().to_str().unwrap(),
            "--graph",
            graph.to_str().unwrap(),
        ],
    );
    assert_eq!(output.status.code(), Some(3), "{}", said(&output));
    let printed = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(
        printed.contains("No combination keeps to the bounds; "),
        "{printed}"
    );
    assert!(!graph.exists());
}

#[cfg(target_os = "linux")]
#[test]
fn without_an_adapter_it_says_what_to_install() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(BINARY);
    command
        .args(["trade", "hall", "--quick", "--out"])
        .arg(folder.path());
    let none = ["VK_DRIVER_FILES", "VK_ICD_FILENAMES"].map(|name| (name, "none"));
    let output = command.envs(none).output().unwrap();
    let said = said(&output);
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("mesa-vulkan-drivers"), "{said}");
    assert!(fs::read_dir(folder.path()).unwrap().next().is_none());
}
