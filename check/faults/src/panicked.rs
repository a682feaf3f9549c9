//! What a panic said, and where.

use std::panic::set_hook;
use std::sync::Mutex;

static LAST: Mutex<String> = Mutex::new(String::new());

/// Keeps what panics say instead of printing it.
pub(crate) fn listen() {
    set_hook(Box::new(|said| {
        if let Ok(mut last) = LAST.lock() {
            *last = said.to_string();
        }
    }));
}

/// What the last panic said.
pub(crate) fn last() -> String {
    LAST.lock().map(|last| last.clone()).unwrap_or_default()
}
