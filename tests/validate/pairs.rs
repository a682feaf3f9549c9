//! Pairs of shaders one line apart, of which Tint takes the good one and refuses the bad one: so do we, but for the known
//! disagreements. `check/agreement/README.md` tells more.

use moment_shadows::{Rule, ShaderError, Source, ValidationOptions, ValidationReport, validate};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

struct Pair {
    kind: String,
    name: String,
    good: String,
    bad: String,
    /// The line in which the bad one differs. `None` if the bad one lacks it.
    bad_line: Option<u32>,
}

impl Pair {
    fn id(&self, side: &str) -> String {
        format!("{}/{}/{side}", self.kind, self.name)
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("check/agreement")
}

fn pairs() -> Vec<Pair> {
    let mut pairs = Vec::new();
    let mut files: Vec<_> = fs::read_dir(folder().join("pairs"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|found| found == "pairs"))
        .collect();
    files.sort();
    for path in files {
        let kind = path.file_stem().unwrap().to_str().unwrap();
        read_pairs(kind, &fs::read_to_string(&path).unwrap(), &mut pairs);
    }
    assert!(pairs.len() >= 600, "{} pairs", pairs.len());
    pairs
}

fn read_pairs(kind: &str, text: &str, pairs: &mut Vec<Pair>) {
    for line in text.lines() {
        if let Some(name) = line.strip_prefix("=== ") {
            pairs.push(Pair {
                kind: kind.to_owned(),
                name: name.to_owned(),
                good: String::new(),
                bad: String::new(),
                bad_line: None,
            });
            continue;
        }
        let pair = pairs.last_mut().expect("a name before the first line");
        let (good, bad) = (line.strip_prefix("good|"), line.strip_prefix("bad |"));
        if bad.is_some_and(|bad| !bad.trim().is_empty()) {
            let before = pair.bad.lines().count();
            pair.bad_line = Some(u32::try_from(before).unwrap() + 1);
        }
        for (side, own, other) in [(&mut pair.good, good, bad), (&mut pair.bad, bad, good)] {
            if other.is_none() {
                side.push_str(own.unwrap_or(line));
                side.push('\n');
            }
        }
    }
}

/// The texts of which Tint is known to say something else.
fn known_disagreements() -> BTreeSet<String> {
    let text = fs::read_to_string(folder().join("reasons.json")).unwrap();
    let reasons: Vec<serde_json::Value> = serde_json::from_str(&text).unwrap();
    reasons
        .iter()
        .flat_map(|reason| reason["texts"].as_array().unwrap())
        .map(|id| id.as_str().unwrap().to_owned())
        // The others are files of packages.
        .filter(|id| id.contains('/'))
        .collect()
}

fn report(text: &str) -> ValidationReport {
    let source = Source {
        name: "pair.wgsl",
        text,
    };
    validate(source, &ValidationOptions::default())
}

#[test]
fn good_ones_are_valid_and_bad_ones_are_not() {
    let mut known = known_disagreements();
    let mut wrong = Vec::new();
    for pair in pairs() {
        for (side, text) in [("good", &pair.good), ("bad", &pair.bad)] {
            let (id, report) = (pair.id(side), report(text));
            let right = report.is_valid() == (side == "good");
            match (right, known.remove(&id)) {
                (false, false) if side == "good" => wrong.push(format!("{id}: refused\n{report}")),
                (false, false) => wrong.push(format!("{id}: accepted")),
                (true, true) => wrong.push(format!("{id}: right, and in reasons.json")),
                _ => {}
            }
        }
    }
    wrong.extend(
        known
            .iter()
            .map(|id| format!("{id}: in reasons.json, and no pair")),
    );
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// `unsupported` says that browsers with Tint take the shader. Here they take the good one, and we do; so it is the fault that
/// has to be named.
#[test]
fn faults_are_not_said_to_be_unsupported() {
    let mut wrong = Vec::new();
    for pair in pairs() {
        let bad = report(&pair.bad);
        // Of what makes the compiler panic nobody knows more, and nothing more is said; attributes end its work.
        let unknown = |error: &ShaderError| {
            let message = &error.message;
            message.contains("stops here") || message.contains("`@diagnostic(…)`")
        };
        let unsupported = |error: &ShaderError| error.rule == Rule::Unsupported && !unknown(error);
        if !bad.is_valid() && bad.errors.iter().all(unsupported) && report(&pair.good).is_valid() {
            wrong.push(format!("{}: {bad}", pair.id("bad")));
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Most faults are shown where they are. The others come from elsewhere: from a declaration, or from what is missing.
#[test]
fn most_bad_lines_are_pointed_at() {
    let mut counts = BTreeMap::new();
    for pair in pairs() {
        let Some(bad_line) = pair.bad_line else {
            continue;
        };
        let report = report(&pair.bad);
        let mut places = report.errors.iter().flat_map(|error| &error.places);
        if !report.is_valid() {
            let (of, on_it) = counts.entry(pair.kind).or_insert((0_u32, 0_u32));
            *of += 1;
            *on_it += u32::from(places.any(|place| place.line == bad_line));
        }
    }
    for (kind, (of, on_it)) in &counts {
        println!("{kind}: {on_it} of {of} bad lines are pointed at");
    }
    let of: u32 = counts.values().map(|(of, _)| of).sum();
    let on_it: u32 = counts.values().map(|(_, on_it)| on_it).sum();
    assert!(
        4 * on_it >= 3 * of,
        "{on_it} of {of} bad lines are pointed at"
    );
}
