//! The command `moment-shadows`: a file has the options of each sub-command, and runs it.
//!
//! Other programs, as the instrument of this library, take the sub-commands into their own command line.

pub mod adapter;
pub mod argument;
pub mod export;
pub mod export_plan;
pub mod graph;
pub mod runtime_dir;
pub mod validate;

mod error;
mod graph_file;
mod output;
mod panic;
mod part;
mod read;

use std::process::ExitCode;

use clap::{CommandFactory, Parser, Subcommand};

pub use error::CommandError;
pub use graph_file::GraphFile;
pub use panic::leave_out_compiler;
pub use part::Part;

/// The exit code where nobody reads the output to its end, as shells have it.
pub const NOT_READ: u8 = 141;

/// Filterable shadows: validates shaders, checks graphs, exports their plans, and techniques in other languages.
#[derive(Debug, Parser)]
#[command(
    name = "moment-shadows",
    version,
    after_help = "Exit codes: 0 all is well, 1 something is not valid or has failed, 2 wrong usage."
)]
pub struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The sub-commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Validates shaders, linked with the modules they import, for every backend.
    Validate(validate::Options),
    /// Checks and prints a graph file.
    Graph(graph::Options),
    /// Compiles a graph file and writes its plan as JSON, for a recorder in any language.
    ExportPlan(export_plan::Options),
    /// Writes a technique as functions in another shading language, with vectors that prove a port.
    Export(export::Options),
    /// Prints the graphics adapter that graphs run on; fails if there is none.
    Adapter,
}

impl Cli {
    /// The command line's parser.
    #[must_use]
    pub fn parser() -> clap::Command {
        Self::command()
    }

    /// What the process was called with; ends it with a message where that is wrong.
    #[must_use]
    pub fn of_process() -> Self {
        Self::parse()
    }

    /// Runs the sub-command as [`Command::run`] does.
    #[must_use]
    pub fn run(self) -> ExitCode {
        self.command.run()
    }
}

impl Command {
    /// Runs it, says what is wrong, and gives what the process ends with.
    #[must_use]
    pub fn run(self) -> ExitCode {
        let result = match self {
            Self::Validate(options) => options.run(),
            Self::Graph(options) => options.run(),
            Self::ExportPlan(options) => options.run(),
            Self::Export(options) => options.run(),
            Self::Adapter => adapter::run(),
        };
        result.unwrap_or_else(|error| {
            if error.is_not_read() {
                return ExitCode::from(NOT_READ);
            }
            output::say(format_args!("error: {error}"));
            ExitCode::FAILURE
        })
    }
}
