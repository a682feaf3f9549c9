//! The command `moment-shadows`.

use std::process::ExitCode;

use moment_shadows_graph::command::{Cli, runtime_dir};

fn main() -> ExitCode {
    runtime_dir::ensure();
    Cli::of_process().run()
}
