//! `moment-shadows adapter`: the graphics adapter that the other commands use.

use std::process::ExitCode;

use moment_shadows::Profile;

use super::CommandResult;
use crate::gpu::Gpu;

/// Prints it.
pub fn run() -> CommandResult {
    let info = Gpu::open(Profile::WebgpuCore)?.adapter.get_info();
    println!(
        "{} ({:?}, {:?}, {})",
        info.name, info.device_type, info.backend, info.driver_info
    );
    Ok(ExitCode::SUCCESS)
}
