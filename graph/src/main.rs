//! The command `moment-shadows`.

use std::process::ExitCode;

use moment_shadows_graph::command::{Cli, leave_out_compiler, runtime_dir};

fn main() -> ExitCode {
    runtime_dir::ensure();
    leave_out_compiler();
    Cli::of_process().run()
}
