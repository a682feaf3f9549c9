//! `XDG_RUNTIME_DIR` where nobody has set it.
//!
//! Mesa's Vulkan driver looks for a Wayland display there on every start, and without the variable it prints two lines that begin
//! with "error", although nothing is wrong.

/// Starts this process anew with the variable set to the folder for temporary files, unless it is set. Returns where there is
/// nothing to do, and where the process cannot be started anew: it then goes on with the driver's complaints.
pub fn ensure() {
    #[cfg(target_os = "linux")]
    if std::env::var_os("XDG_RUNTIME_DIR").is_none()
        && let Ok(program) = std::env::current_exe()
    {
        use std::os::unix::process::CommandExt;
        let _ = std::process::Command::new(program)
            .args(std::env::args_os().skip(1))
            .env("XDG_RUNTIME_DIR", std::env::temp_dir())
            .exec();
    }
}
