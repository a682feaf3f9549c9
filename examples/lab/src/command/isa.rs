//! `moment-shadows-lab isa`: what a real shader compiler makes of every shader, and the gate on it.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use crate::error::LabError;
use crate::isa::child;
use crate::isa::chip::Chip;
use crate::isa::compare::compare;
use crate::isa::table::Table;

/// What `isa` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The chip.
    #[arg(long, value_enum, default_value = "all")]
    chip: ChipArgument,
    /// Prints the table as JSON.
    #[arg(long, conflicts_with_all = ["check", "update", "shader"])]
    json: bool,
    /// Compares with the table that is kept, and fails where a figure is over 5 % higher.
    #[arg(long, conflicts_with_all = ["update", "shader"])]
    check: bool,
    /// Replaces the table that is kept.
    #[arg(long, conflicts_with_all = ["chip", "shader"])]
    update: bool,
    /// Prints the code of one shader, by its name in the table.
    #[arg(long)]
    shader: Option<String>,
    /// The table that is kept.
    #[arg(long, default_value = "examples/lab/isa/table.json")]
    table: PathBuf,
}

#[derive(Clone, Copy, clap::ValueEnum)]
enum ChipArgument {
    Navi21,
    Vega10,
    All,
}

impl Options {
    /// Compiles every shader, or prints one; [`ExitCode::FAILURE`] where a check finds a figure above the table.
    pub fn run(self) -> CommandResult {
        let chips: &[Chip] = match self.chip {
            ChipArgument::Navi21 => &[Chip::Navi21],
            ChipArgument::Vega10 => &[Chip::Vega10],
            ChipArgument::All => &Chip::ALL,
        };
        let path = &self.table;
        if self.update {
            child::table(&Chip::ALL)?.write(path)?;
            println!("{} is up to date", path.display());
        } else if self.check {
            let (before, now) = (Table::read(path)?, child::table(chips)?);
            let compared = compare(&before, &now).ok_or_else(|| {
            let reason = format!(
                "it belongs to {} {}, but this is {} {}, whose figures cannot be compared with it; install that driver, or \
                 make a table for this one with `isa --update`",
                before.driver.name, before.driver.version, now.driver.name, now.driver.version
            );
            LabError::unsuitable(path.display(), reason)
        })?;
            print!("{compared}");
            if !compared.passed() {
                return Ok(ExitCode::FAILURE);
            }
        } else if let Some(shader) = &self.shader {
            for &chip in chips {
                println!("{chip}\n{}", child::disassembly(chip, shader)?);
            }
        } else if self.json {
            let text = serde_json::to_string_pretty(&child::table(chips)?);
            println!(
                "{}",
                text.map_err(|error| LabError::unsuitable(path.display(), error))?
            );
        } else {
            print!("{}", child::table(chips)?);
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// What the process takes that compiles for one chip.
#[derive(clap::Args)]
pub struct ChildOptions {
    #[arg(value_enum)]
    chip: Chip,
    shader: Option<String>,
}

impl ChildOptions {
    /// Prints what was compiled, for the process that asked for it.
    pub fn run(self) -> CommandResult {
        print!("{}", child::compile(self.chip, self.shader.as_deref())?);
        Ok(ExitCode::SUCCESS)
    }
}
