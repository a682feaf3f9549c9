//! Compiling for a chip takes a process of its own: the driver reads the chip's name from the environment, once, and ends
//! the process for chips that it does not quite know.

use std::process::Command;

use super::chip::Chip;
use super::compiler::Compiler;
use super::driver::manifest;
use super::figures::{Figures, Row};
use super::subjects::{Subject, subjects};
use super::table::{ChipRows, Table};
use crate::error::LabError;

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

/// The table for some chips, a process each, which writes the table of its own. The program that runs must know the
/// subcommand [`COMMAND`].
pub fn table(chips: &[Chip]) -> Result<Table, LabError> {
    let mut compiled = Table::default();
    for &chip in chips {
        let own: Table =
            serde_json::from_str(&run(chip, None)?).map_err(|error| failed(chip, error))?;
        compiled.driver = own.driver;
        compiled.chips.extend(own.chips);
    }
    Ok(compiled)
}

fn failed(chip: Chip, reason: impl ToString) -> LabError {
    LabError::unsuitable(format!("compiling for {chip} failed"), reason)
}

/// The disassembly of one shader.
pub fn disassembly(chip: Chip, shader: &str) -> Result<String, LabError> {
    run(chip, Some(shader))
}

fn run(chip: Chip, shader: Option<&str>) -> Result<String, LabError> {
    let manifest = manifest()?;
    let program = std::env::current_exe().map_err(|error| failed(chip, error))?;
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
    let output = command.output().map_err(|error| failed(chip, error))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let said = String::from_utf8_lossy(&output.stderr);
    // Drivers warn before; the error is the last line.
    let error = said.lines().last().unwrap_or_default();
    let reason = match error.strip_prefix("error: ") {
        Some(error) => error.to_owned(),
        None => format!(
            "the driver ended the process ({}); it may not know the chip",
            output.status
        ),
    };
    Err(failed(chip, reason))
}

/// What the process prints: the figures of all shaders as JSON, or the disassembly of one.
pub fn compile(chip: Chip, shader: Option<&str>) -> Result<String, LabError> {
    let subjects = subjects()?;
    let compiler = Compiler::open(chip)?;
    if let Some(name) = shader {
        let subject = subjects.iter().find(|subject| subject.name == name);
        let subject = subject.ok_or_else(|| {
            let names = subjects.iter().map(|subject| subject.name.as_str());
            let nearest = moment_shadows::nearest(name, names);
            LabError::unsuitable(
                format!("shader '{name}'"),
                format!("there is none; the nearest are {nearest}"),
            )
        })?;
        return Ok(compiler.compile(subject)?.executable.isa);
    }
    let row = |subject: &Subject| {
        Ok(Row {
            shader: subject.name.clone(),
            figures: Figures::of(subject, &compiler.compile(subject)?, chip)?,
        })
    };
    let shaders = subjects.iter().map(row).collect::<Result<_, LabError>>()?;
    let table = Table {
        driver: compiler.driver,
        chips: vec![ChipRows { chip, shaders }],
    };
    serde_json::to_string(&table).map_err(|error| failed(chip, error))
}
