//! Panics of other people's code as errors.

use std::any::Any;
use std::cell::{Cell, RefCell};
use std::panic::{self, Location, UnwindSafe};
use std::sync::Once;

thread_local! {
    /// Whether panics of this thread are caught, so that nothing need be printed.
    static CAUGHT: Cell<bool> = const { Cell::new(false) };
    /// Where the last one was.
    static PLACE: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Calls `read`. A panic in it is an error with the panic's message and place, and prints nothing.
pub(super) fn caught<T>(
    read: impl FnOnce() -> Result<T, String> + UnwindSafe,
) -> Result<T, String> {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        let before = panic::take_hook();
        panic::set_hook(Box::new(move |info| {
            if CAUGHT.get() {
                PLACE.replace(info.location().map(place).unwrap_or_default());
            } else {
                before(info);
            }
        }));
    });
    let outer = CAUGHT.replace(true);
    let result = panic::catch_unwind(read);
    CAUGHT.set(outer);
    result.unwrap_or_else(|panic| {
        let (message, place) = (message(&*panic), PLACE.take());
        Err(format!("it breaks the reader: {message} ({place})"))
    })
}

/// The file and line within its package: where packages lie is nothing that a reader needs.
fn place(location: &Location<'_>) -> String {
    let file = location.file().replace('\\', "/");
    let within = file.rsplit_once("/src/").map(|(folder, file)| {
        let package = folder.rsplit('/').next().unwrap_or_default();
        format!("{package}/src/{file}")
    });
    format!("{}:{}", within.unwrap_or(file), location.line())
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or_else(|| panic.downcast_ref::<&str>().copied())
        .unwrap_or("a panic without a message")
}
