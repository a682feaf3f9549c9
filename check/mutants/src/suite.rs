//! The tests: which there are, how long each takes, and which faults each reaches.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{self, BufRead, BufReader};
use std::os::unix::process::CommandExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant, SystemTime};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::tree::{Places, cargo};

/// A program with tests.
#[derive(Clone, Serialize, Deserialize)]
pub struct Binary {
    pub name: String,
    pub program: PathBuf,
    folder: PathBuf,
    built: SystemTime,
    /// Its tests that count, with the seconds that each takes.
    pub tests: BTreeMap<String, f64>,
    /// For each fault that it reaches, the tests that do; an empty name where a thread of no test does.
    pub reached: BTreeMap<usize, BTreeSet<String>>,
}

/// How a run of tests ended.
pub enum End {
    Passed,
    /// The test that failed, or what happened.
    Failed(String),
}

impl Binary {
    /// A run of `tests`, until one fails. `said` hears of each test that passes.
    pub fn run(
        &self,
        tests: &[&str],
        set: &[(&str, String)],
        limit: Duration,
        mut said: impl FnMut(&str, f64, bool),
    ) -> io::Result<End> {
        let scratch = std::env::temp_dir().join(format!(
            "mutants-{}-{:?}",
            std::process::id(),
            thread::current().id()
        ));
        fs::create_dir_all(&scratch)?;
        let mut command = Command::new(&self.program);
        command
            .args(["-Zunstable-options", "--report-time", "--exact"])
            .args(tests);
        command
            .args(["--test-threads", "2"])
            .current_dir(&self.folder);
        command
            .env("RUSTC_BOOTSTRAP", "1")
            .env("CARGO_MANIFEST_DIR", &self.folder)
            .env("TMPDIR", &scratch);
        command.envs(set.iter().map(|(key, value)| (key, value)));
        let mut child = command
            .process_group(0)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()?;
        let pid = child.id();
        let output = child.stdout.take().ok_or(io::ErrorKind::BrokenPipe)?;
        // A thread ends the run where it takes too long.
        let ended = Arc::new(Mutex::new(false));
        let (watched, start) = (Arc::clone(&ended), Instant::now());
        let watch = thread::spawn(move || {
            while !*watched.lock().expect("no thread panics with it") {
                if start.elapsed() > limit {
                    kill(pid);
                    return true;
                }
                thread::sleep(Duration::from_millis(20));
            }
            false
        });
        let mut failed = None;
        for line in BufReader::new(output).lines().map_while(Result::ok) {
            let Some((name, result)) = line
                .strip_prefix("test ")
                .and_then(|it| it.rsplit_once(" ... "))
            else {
                continue;
            };
            let name = name.split(" - should panic").next().unwrap_or(name);
            let seconds = result
                .split(['<', '>'])
                .nth(1)
                .and_then(|it| it.trim_end_matches('s').parse().ok())
                .unwrap_or(0.0);
            let passes = !result.starts_with("FAILED");
            if !result.starts_with("ignored") {
                said(name, seconds, passes);
            }
            if !passes && failed.is_none() {
                failed = Some(name.to_owned());
                if !set.iter().any(|(key, _)| *key == "MUTANTS_REACHED") {
                    kill(pid);
                }
            }
        }
        let status = child.wait()?;
        *ended.lock().expect("no thread panics with it") = true;
        let hung = watch.join().unwrap_or_default();
        kill(pid);
        let _ = fs::remove_dir_all(&scratch);
        Ok(match failed {
            Some(test) => End::Failed(test),
            None if hung => End::Failed(format!("no end after {} s", limit.as_secs())),
            None if !status.success() => End::Failed(format!("{status}")),
            None => End::Passed,
        })
    }
}

/// Ends a process and those that it started.
fn kill(pid: u32) {
    let _ = Command::new("kill")
        .args(["-9", "--", &format!("-{pid}")])
        .stderr(Stdio::null())
        .status();
}

/// Builds the tests of the copy, and runs those programs anew whose build changed since `known`.
pub fn suite(places: &Places, left_out: &[&str]) -> io::Result<Vec<Binary>> {
    let known: Vec<Binary> = fs::read(&places.suite)
        .ok()
        .and_then(|text| serde_json::from_slice(&text).ok())
        .unwrap_or_default();
    let output = cargo(places)
        .args([
            "test",
            "--release",
            "--locked",
            "--workspace",
            "--lib",
            "--bins",
            "--tests",
            "--no-run",
            "--message-format=json",
        ])
        .stderr(Stdio::inherit())
        .output()?;
    if !output.status.success() {
        return Err(io::Error::other("the tests do not build"));
    }
    let mut all = Vec::new();
    for line in output.stdout.split(|byte| *byte == b'\n') {
        let Ok(line) = serde_json::from_slice::<Value>(line) else {
            continue;
        };
        let (Some(program), true) = (line["executable"].as_str(), line["profile"]["test"] == true)
        else {
            continue;
        };
        let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
        let manifest = PathBuf::from(text(&line["manifest_path"]));
        let name = text(&line["target"]["name"]);
        let built = fs::metadata(program)?.modified()?;
        let fresh = known
            .iter()
            .find(|it| it.program.to_str() == Some(program) && it.built == built);
        if left_out.contains(&name.as_str()) {
            continue;
        }
        let mut binary = Binary {
            name,
            program: program.into(),
            folder: manifest.parent().map(Into::into).unwrap_or_default(),
            built,
            tests: BTreeMap::new(),
            reached: BTreeMap::new(),
        };
        match fresh {
            Some(fresh) => binary = fresh.clone(),
            None => learn(places, &mut binary)?,
        }
        all.push(binary);
        fs::write(&places.suite, serde_json::to_vec(&all)?)?;
    }
    Ok(all)
}

/// Runs all tests without a fault.
fn learn(places: &Places, binary: &mut Binary) -> io::Result<()> {
    let notes = places.texts.join("reached");
    let _ = fs::remove_file(&notes);
    let set = [
        ("MUTANTS_REACHED", notes.to_string_lossy().into_owned()),
        ("MUTANTS_TEXTS", places.texts.to_string_lossy().into_owned()),
    ];
    let start = Instant::now();
    let mut failing = BTreeSet::new();
    let mut tests = BTreeMap::new();
    binary.run(
        &[],
        &set,
        Duration::from_secs(1800),
        |name, seconds, passes| {
            if passes {
                tests.insert(name.to_owned(), seconds);
            } else {
                failing.insert(name.to_owned());
            }
        },
    )?;
    for line in fs::read_to_string(&notes).unwrap_or_default().lines() {
        if let Some((number, test)) = line.split_once('\t')
            && let Ok(number) = number.parse()
        {
            let test = if tests.contains_key(test) || failing.contains(test) {
                test
            } else {
                ""
            };
            let by = binary.reached.entry(number).or_default();
            by.insert(test.to_owned());
        }
    }
    println!(
        "{:6.1} s  {}: {} tests, {} reach",
        start.elapsed().as_secs_f64(),
        binary.name,
        tests.len(),
        binary.reached.len()
    );
    if !failing.is_empty() {
        println!("          fail without a fault: {failing:?}");
    }
    binary.tests = tests;
    Ok(())
}
