//! Panics of other people's code as errors.

use std::any::Any;
use std::cell::Cell;
use std::panic::{self, UnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether panics of this thread are caught, so that nothing need be printed.
    static CAUGHT: Cell<bool> = const { Cell::new(false) };
}

/// Calls `read`. A panic in it is an error with the panic's message, and prints nothing.
pub(super) fn caught<T>(
    read: impl FnOnce() -> Result<T, String> + UnwindSafe,
) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if !CAUGHT.get() {
                before(info);
            }
        }));
    });
    let outer = CAUGHT.replace(true);
    let result = panic::catch_unwind(read);
    CAUGHT.set(outer);
    result.unwrap_or_else(|panic| Err(format!("it breaks the reader: {}", message(&*panic))))
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("a panic without a message")
}
