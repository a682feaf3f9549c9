//! The `moment-shadows` command.

use std::process::ExitCode;

use moment_shadows_lab::{cli::Cli, picture, runtime_dir};

/// The exit code after Ctrl-C, as shells have it.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    runtime_dir::ensure();
    // A process that something else started may ignore the signal until it is told.
    let _ = ctrlc::set_handler(|| {
        picture::remove_part();
        std::process::exit(INTERRUPTED);
    });
    match Cli::of_process().run() {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
