//! The command `moment-shadows-lab`.

use std::process::ExitCode;

use moment_shadows_graph::command::{NOT_READ, leave_out_compiler, runtime_dir};
use moment_shadows_lab::{cli::Cli, picture};

/// The exit code after Ctrl-C, as shells have it.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    runtime_dir::ensure();
    // A process that something else started may ignore the signal until it is told.
    let _ = ctrlc::set_handler(|| {
        picture::remove_part();
        std::process::exit(INTERRUPTED);
    });
    leave_out_compiler();
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let said = panic.payload_as_str().unwrap_or_default();
        if let Some((_, reason)) = said.split_once("failed printing to stdout: ") {
            // Whoever read the output has had enough of it.
            if reason.contains("Broken pipe") {
                std::process::exit(NOT_READ.into());
            }
            eprintln!("error: the output cannot be written: {reason}");
            std::process::exit(1);
        }
        usual(panic);
    }));
    match Cli::of_process().run() {
        Ok(code) => code,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
