//! `moment-shadows validate`: checks shader files under a profile, as one would in continuous integration.

mod files;
mod github;
mod json;
mod modules;
mod sarif;
mod text;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::ValueEnum;
use moment_shadows::{
    Features, Profile, Rule, ShaderError, Source, ValidationOptions, ValidationReport, validate,
};

use self::modules::Modules;
use super::{CommandError, argument, output, read};

/// What `validate` takes.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// WGSL files, and folders: all files below that end in `.wgsl`.
    #[arg(required = true, value_name = "PATH")]
    paths: Vec<PathBuf>,
    /// What the shaders may rely on.
    #[arg(long, value_parser = argument::profile())]
    profile: Option<Profile>,
    /// Modules of your own that shaders import: a folder `my_engine`, whose file `lights.wgsl` is `my_engine::lights`, or one file of
    /// such a folder. `NAME=PATH` gives another name.
    #[arg(long = "module", value_name = "[NAME=]PATH")]
    modules: Vec<String>,
    /// Optional features that the shaders may use as well, by commas: `f16`, `subgroups` and the like.
    #[arg(long, value_delimiter = ',', value_name = "FEATURE", value_parser = feature)]
    allow: Vec<Features>,
    /// How the result is written.
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Says nothing of files that are valid.
    #[arg(long)]
    quiet: bool,
}

/// A form of the output.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// For people.
    #[default]
    Text,
    /// One object, described in docs/ci.md.
    Json,
    /// Annotations of GitHub's workflows.
    Github,
    /// SARIF 2.1.0, for code scanning.
    Sarif,
}

fn feature(name: &str) -> Result<Features, String> {
    name.parse()
        .map_err(|error: moment_shadows::UnknownFeature| error.to_string())
}

/// A file that cannot be read is a fault beside those of others.
fn not_read(error: &CommandError) -> ValidationReport {
    ValidationReport {
        errors: vec![ShaderError {
            rule: Rule::File,
            message: error.to_string(),
            places: Vec::new(),
            notes: Vec::new(),
        }],
        ..ValidationReport::default()
    }
}

/// A file and what was found in it.
struct Checked {
    name: String,
    report: ValidationReport,
}

/// All that was found.
struct Outcome {
    profile: Profile,
    files: Vec<Checked>,
}

impl Outcome {
    fn invalid(&self) -> usize {
        self.files.iter().filter(|it| !it.report.is_valid()).count()
    }

    /// Every finding, with its severity.
    fn findings(&self) -> impl Iterator<Item = (&'static str, &Checked, &ShaderError)> {
        self.files.iter().flat_map(|file| {
            let errors = file.report.errors.iter().map(move |it| ("error", file, it));
            let warnings = file
                .report
                .warnings
                .iter()
                .map(move |it| ("warning", file, it));
            errors.chain(warnings)
        })
    }
}

impl Options {
    /// Validates the files, in their order, and prints what is found. Fails if any is not valid.
    ///
    /// # Errors
    /// [`CommandError`] if a folder or a module cannot be read, or the output cannot be written.
    pub fn run(self) -> Result<ExitCode, CommandError> {
        let profile = self.profile.unwrap_or_default();
        let modules = Modules::read(&self.modules)?;
        let sources = modules.sources();
        let none = Features::default();
        let options = ValidationOptions {
            profile,
            features: self.allow.iter().fold(none, |all, it| all.and(*it)),
            modules: &sources,
        };
        let mut outcome = Outcome {
            profile,
            files: Vec::new(),
        };
        for path in files::all(&self.paths)? {
            let name = path.display().to_string();
            let mut report = match read::read(&path, ValidationReport::LONGEST_SHADER) {
                Ok(text) => {
                    let source = Source {
                        name: &name,
                        text: &text,
                    };
                    validate(source, &options)
                }
                Err(error) => not_read(&error),
            };
            modules.name_files(&mut report);
            outcome.files.push(Checked { name, report });
        }
        match self.format {
            Format::Text => text::print(&outcome, self.quiet)?,
            Format::Json => output::print(serde_json::to_string_pretty(&json::of(
                &outcome, self.quiet,
            ))?)?,
            Format::Github => github::print(&outcome)?,
            Format::Sarif => output::print(serde_json::to_string_pretty(&sarif::of(&outcome))?)?,
        }
        Ok(match outcome.invalid() {
            0 => ExitCode::SUCCESS,
            _ => ExitCode::FAILURE,
        })
    }
}
