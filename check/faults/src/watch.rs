//! What takes too long hangs.

use std::sync::atomic::{AtomicU64, Ordering::SeqCst};
use std::time::Duration;

/// A story takes a part of a second.
const LONGEST: Duration = Duration::from_secs(120);

static TOLD: AtomicU64 = AtomicU64::new(0);

/// Says that a story begins.
pub(crate) fn begun() {
    TOLD.fetch_add(1, SeqCst);
}

/// Ends the process where one story takes too long.
pub(crate) fn over(what: String) {
    let before = TOLD.load(SeqCst);
    std::thread::spawn(move || {
        std::thread::sleep(LONGEST);
        if TOLD.load(SeqCst) == before {
            eprintln!("{what}: it hangs");
            std::process::exit(1);
        }
    });
}
