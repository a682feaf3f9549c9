//! Panics of the WGSL compiler. Each becomes an error with a place, so that what Rust prints of it says nothing more.

use std::thread;

use moment_shadows::COMPILER_THREAD;

/// Leaves out what is printed of a panic on the compiler's thread; others go to the hook that was there.
pub fn leave_out_compiler() {
    let others = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        if thread::current().name() != Some(COMPILER_THREAD) {
            others(panic);
        }
    }));
}
