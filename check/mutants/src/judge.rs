//! A fault, and the tests that may notice it.

use std::collections::BTreeSet;
use std::fmt;
use std::io;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use crate::site::{Site, key};
use crate::suite::{Binary, End};
use crate::tree::Places;

/// What is known of a fault.
#[derive(Clone, Serialize, Deserialize)]
pub struct Verdict {
    pub file: String,
    pub line: usize,
    /// The text of the line.
    pub code: String,
    pub what: String,
    /// How many places of the file before it have the same words.
    pub nth: usize,
    /// A shader with it does not compile: it is not judged.
    pub invalid: bool,
    /// The test that noticed it.
    pub noticed_by: Option<String>,
    /// How many tests that reach it passed with it, and how many there are.
    pub passed: usize,
    pub reaching: usize,
}

impl Verdict {
    fn new(site: &Site) -> Self {
        Self {
            file: site.file.clone(),
            line: site.line,
            code: site.code.clone(),
            what: site.what.clone(),
            nth: site.nth,
            invalid: false,
            noticed_by: None,
            passed: 0,
            reaching: 0,
        }
    }

    pub fn key(&self) -> String {
        key(&self.file, &self.code, &self.what, self.nth)
    }

    pub fn invalid(site: &Site) -> Self {
        Self {
            invalid: true,
            ..Self::new(site)
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            file,
            line,
            code,
            what,
            passed,
            reaching,
            ..
        } = self;
        let verdict = match &self.noticed_by {
            Some(test) => format!("noticed by {test}"),
            None if self.invalid => "does not compile".to_owned(),
            None => format!("passes {passed} of {reaching} tests that reach it"),
        };
        write!(to, "{file}:{line}: {what} in `{code}`: {verdict}")
    }
}

/// Seconds of tests that run together; those beyond the last run last.
const STEPS: [f64; 5] = [0.1, 1.0, 5.0, 30.0, f64::INFINITY];

/// Tests that reach the fault, cheapest first, until one fails or `limit` seconds of tests have run.
pub fn judge(
    places: &Places,
    suite: &[Binary],
    site: &Site,
    number: usize,
    limit: f64,
) -> io::Result<Verdict> {
    let mut verdict = Verdict::new(site);
    let set = [
        ("MUTANT", number.to_string()),
        ("MUTANTS_TEXTS", places.texts.to_string_lossy().into_owned()),
    ];
    let none = BTreeSet::new();
    // First those that are known to reach it, then those of a program in which something else does.
    let mut runs: Vec<(bool, usize, f64, &Binary, Vec<&str>)> = Vec::new();
    for binary in suite {
        let by = binary.reached.get(&number).unwrap_or(&none);
        let mut groups: Vec<(bool, usize, f64, &Binary, Vec<&str>)> = Vec::new();
        for (test, &seconds) in &binary.tests {
            let known = by.contains(test);
            if !known && !by.contains("") {
                continue;
            }
            verdict.reaching += 1;
            let step = STEPS
                .iter()
                .position(|&step| seconds < step)
                .unwrap_or(STEPS.len() - 1);
            match groups.iter_mut().find(|it| (it.0, it.1) == (!known, step)) {
                Some(group) => {
                    group.2 += seconds;
                    group.4.push(test);
                }
                None => groups.push((!known, step, seconds, binary, vec![test])),
            }
        }
        runs.extend(groups);
    }
    runs.sort_by(|a, b| (a.1, a.0).cmp(&(b.1, b.0)).then(a.2.total_cmp(&b.2)));
    let mut spent = 0.0;
    for (_, _, seconds, binary, tests) in runs {
        if spent + seconds > limit {
            continue;
        }
        let start = Instant::now();
        let bound = Duration::from_secs_f64(240.0 + 20.0 * seconds);
        let end = binary.run(&tests, &set, bound, |_, _, passes| {
            verdict.passed += usize::from(passes)
        })?;
        spent += start.elapsed().as_secs_f64().min(seconds + 0.1);
        if let End::Failed(by) = end {
            verdict.noticed_by = Some(format!("{}: {by}", binary.name));
            break;
        }
    }
    Ok(verdict)
}
