//! Compiling for a chip takes a process of its own: the driver reads the chip's name from the environment, once, and ends
//! the process for chips that it does not quite know.

use std::process::Command;

use serde::{Deserialize, Serialize};

use super::chip::Chip;
use super::compiler::Compiler;
use super::driver::{Driver, manifest};
use super::error::IsaError;
use super::figures::{Figures, Row};
use super::subjects::subjects;
use super::table::{ChipRows, Table};

/// The subcommand that the process runs.
pub const COMMAND: &str = "isa-chip";

/// Variables that would change what the driver does.
const UNSET: [&str; 6] = [
    "RADV_DEBUG",
    "RADV_PERFTEST",
    "ACO_DEBUG",
    "NIR_DEBUG",
    "VK_INSTANCE_LAYERS",
    "VK_LOADER_LAYERS_ENABLE",
];

/// What the process writes.
#[derive(Serialize, Deserialize)]
struct Report {
    driver: Driver,
    rows: ChipRows,
}

/// The table for some chips, a process each. The program that runs must know the subcommand [`COMMAND`].
pub fn table(chips: &[Chip]) -> Result<Table, IsaError> {
    let mut compiled: Option<Table> = None;
    for &chip in chips {
        let report: Report =
            serde_json::from_str(&run(chip, None)?).map_err(|error| IsaError::Child {
                chip,
                reason: error.to_string(),
            })?;
        match &mut compiled {
            Some(table) => table.chips.push(report.rows),
            None => {
                compiled = Some(Table {
                    driver: report.driver,
                    chips: vec![report.rows],
                });
            }
        }
    }
    compiled.ok_or(IsaError::NoDevice)
}

/// The disassembly of one shader.
pub fn disassembly(chip: Chip, shader: &str) -> Result<String, IsaError> {
    run(chip, Some(shader))
}

fn run(chip: Chip, shader: Option<&str>) -> Result<String, IsaError> {
    let failed = |reason: String| IsaError::Child { chip, reason };
    let manifest = manifest()?;
    let program = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
    let mut command = Command::new(program);
    command.args([COMMAND, chip.name()]).args(shader);
    for name in UNSET {
        command.env_remove(name);
    }
    // Old and new names of the same two settings.
    for name in ["VK_ICD_FILENAMES", "VK_DRIVER_FILES"] {
        command.env(name, &manifest);
    }
    for name in ["RADV_FORCE_FAMILY", "AMD_FORCE_FAMILY"] {
        command.env(name, chip.name());
    }
    // Nothing is left behind in the user's folders.
    command.env("MESA_SHADER_CACHE_DISABLE", "true");
    let output = command
        .output()
        .map_err(|error| failed(error.to_string()))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    // Drivers warn before; the error is the last line.
    let error = said.lines().last().unwrap_or_default();
    Err(failed(match error.strip_prefix("error: ") {
        Some(error) => error.to_owned(),
        None => format!(
            "the driver ended the process ({}); it may not know the chip",
            output.status
        ),
    }))
}

/// What the process prints: the figures of all shaders as JSON, or the disassembly of one.
pub fn compile(chip: Chip, shader: Option<&str>) -> Result<String, IsaError> {
    let subjects = subjects()?;
    let compiler = Compiler::open(chip)?;
    if let Some(name) = shader {
        let subject = subjects.iter().find(|subject| subject.name == name);
        let subject = subject.ok_or_else(|| IsaError::UnknownShader {
            name: name.to_owned(),
            nearest: moment_shadows::nearest(
                name,
                subjects.iter().map(|subject| subject.name.as_str()),
            ),
        })?;
        return Ok(compiler.compile(subject)?.executable.isa);
    }
    let mut rows = ChipRows {
        chip,
        shaders: Vec::new(),
    };
    for subject in &subjects {
        let compiled = compiler.compile(subject)?;
        rows.shaders.push(Row {
            shader: subject.name.clone(),
            figures: Figures::of(subject, &compiled, chip)?,
        });
    }
    let report = Report {
        driver: compiler.driver.clone(),
        rows,
    };
    serde_json::to_string(&report).map_err(|error| IsaError::Child {
        chip,
        reason: error.to_string(),
    })
}
