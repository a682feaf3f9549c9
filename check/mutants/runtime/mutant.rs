//! Which planted fault is on, in the copy of the tree that has them all.

use std::cell::Cell;
use std::env;
use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::sync::LazyLock;
use std::thread;

struct State {
    /// The fault that is on, or 0.
    active: usize,
    /// Faults in WGSL: the number, the declaration and what stands in its place.
    texts: Vec<(usize, String, String)>,
    /// Where each fault that is reached is noted, with the test that reached it.
    reached: Option<File>,
}

static STATE: LazyLock<State> = LazyLock::new(|| {
    let number = env::var("MUTANT").ok().and_then(|it| it.parse().ok());
    let active = number.unwrap_or(0);
    let reached = env::var_os("MUTANTS_REACHED")
        .and_then(|path| OpenOptions::new().create(true).append(true).open(path).ok());
    let mut texts = Vec::new();
    if let Some(folder) = env::var_os("MUTANTS_TEXTS") {
        for number in 1..LIMIT {
            let read = |kind: &str| {
                let path = std::path::Path::new(&folder).join(format!("{number}.{kind}"));
                fs::read_to_string(path).ok()
            };
            if (active == number || reached.is_some())
                && let Some((original, fault)) = read("original").zip(read("fault"))
            {
                texts.push((number, original, fault));
            }
        }
    }
    State { active, texts, reached }
});

const LIMIT: usize = 1024;

thread_local! {
    static SEEN: Cell<[u64; LIMIT / 64]> = const { Cell::new([0; LIMIT / 64]) };
}

/// Whether a fault is on.
#[must_use]
pub fn on(number: usize) -> bool {
    let state = &*STATE;
    if state.reached.is_some() {
        note(state, number);
    }
    state.active == number
}

fn note(state: &State, number: usize) {
    let mut seen = SEEN.get();
    let (word, bit) = (number / 64, 1 << (number % 64));
    if seen[word] & bit != 0 {
        return;
    }
    seen[word] |= bit;
    SEEN.set(seen);
    if let Some(mut file) = state.reached.as_ref() {
        let thread = thread::current();
        let line = format!("{number}\t{}\n", thread.name().unwrap_or_default());
        let _ = file.write_all(line.as_bytes());
    }
}

/// A text of WGSL with the fault that is on.
#[must_use]
pub fn text(text: &str) -> &str {
    let state = &*STATE;
    for (number, original, fault) in &state.texts {
        if *number == state.active && text.contains(original) {
            return text.replace(original, fault).leak();
        }
    }
    text
}

/// Notes the faults within a linked text.
pub fn linked(text: &str) {
    let state = &*STATE;
    if state.reached.is_some() {
        for (number, original, _) in &state.texts {
            if text.contains(original) {
                note(state, *number);
            }
        }
    }
}
