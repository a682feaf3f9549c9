//! The sub-commands of `moment-shadows-lab` that are not the library's: a file has the options of each, and runs it.

pub(crate) mod argument;
pub mod best;
pub mod bias;
pub mod choose;
pub mod claims;
pub mod contact_shadows;
pub mod cost;
pub mod cost_chart;
pub mod drawn;
pub mod error;
pub mod error_table;
pub mod first_frame;
pub mod inspect;
pub mod isa;
pub mod march_error;
pub mod measure;
pub mod ports;
pub mod probe;
pub mod render;
pub mod scattering_error;
pub mod scattering_flicker;
pub mod scores;
pub mod shaders;
pub mod soak;
pub mod soft_error;
pub mod stability;
pub mod sweep;
pub mod technique_pictures;
pub mod trade;
pub mod transmittance;
pub mod troubleshooting_pictures;
pub mod vectors;

use core::fmt::Display;
use std::error::Error;
use std::process::ExitCode;

use serde::Serialize;

/// What a command ends with: its exit code, or what it says before it ends with 1.
pub type CommandResult = Result<ExitCode, Box<dyn Error>>;

/// Prints what was found, as JSON where that is asked for.
pub fn print(report: &(impl Serialize + Display), json: bool) -> CommandResult {
    if json {
        println!("{}", serde_json::to_string_pretty(report)?);
    } else {
        print!("{report}");
    }
    Ok(ExitCode::SUCCESS)
}

/// Prints several, one below the other.
pub fn print_all(reports: &[impl Serialize + Display], json: bool) -> CommandResult {
    if json {
        println!("{}", serde_json::to_string_pretty(reports)?);
        return Ok(ExitCode::SUCCESS);
    }
    for report in reports {
        println!("{report}");
    }
    Ok(ExitCode::SUCCESS)
}
