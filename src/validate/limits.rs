//! The size of what is validated, and the stack that it takes: the WGSL compiler recurses over long chains.

use super::ValidateError;

/// The longest text that is validated, in bytes, before and after linking.
pub const LONGEST_SHADER: usize = 1 << 19;

/// A byte of a text takes less than 1 KiB in an optimised build: the worst is a chain of `!`. What is not touched
/// takes addresses and no memory.
const STACK_BYTES: usize = LONGEST_SHADER << 10;

/// Runs `work` on a thread with a large stack. `None` if the thread cannot be started, or `work` panics.
pub(super) fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

pub(super) fn refuse_too_long(file: &str, text: &str) -> Result<(), ValidateError> {
    if text.len() > LONGEST_SHADER {
        return Err(ValidateError::TooLong {
            file: file.to_owned(),
            bytes: text.len(),
        });
    }
    Ok(())
}
