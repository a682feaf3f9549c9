//! `moment-shadows export`: a technique as functions in another shading language.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{MapEncoding, Storage, Target, Technique, Vectors};

use super::{CommandError, Part, argument, output};

/// What `export` takes.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// The technique: its name, or its name with settings as graph files have them: `{"evsm4": {"positive": 20}}`.
    #[arg(long, value_parser = technique)]
    technique: Technique,
    /// How texels are stored.
    #[arg(long, value_parser = argument::named(Storage::ALL, Storage::name))]
    storage: Storage,
    /// The language.
    #[arg(long, value_parser = argument::named(Target::ALL, Target::name))]
    target: Target,
    /// The file to write instead of the output, or a folder for it; vectors are written beside it, as JSON.
    #[arg(long, value_name = "FILE|FOLDER")]
    out: Option<PathBuf>,
}

/// A technique by name, or with settings.
fn technique(text: &str) -> Result<Technique, String> {
    let json = if text.trim_start().starts_with('{') {
        text.to_owned()
    } else {
        serde_json::Value::from(text).to_string()
    };
    serde_json::from_str(&json).map_err(|error| error.to_string())
}

impl Options {
    /// Writes the functions, and vectors beside a file.
    ///
    /// # Errors
    /// [`CommandError`] if the technique cannot be exported, or a file cannot be written.
    pub fn run(self) -> Result<ExitCode, CommandError> {
        if self.technique.reads_depth() {
            return Err(CommandError::ReadsDepth(self.technique.name()));
        }
        let encoding = MapEncoding::new(self.technique, self.storage)?;
        let Some(out) = &self.out else {
            let exported = moment_shadows::export(&encoding, self.target)?;
            output::print(exported.text.trim_end())?;
            return Ok(ExitCode::SUCCESS);
        };
        let path = if out.is_dir() {
            let name = format!("{}_{}", encoding.technique(), encoding.storage());
            out.join(name).with_extension(self.target.extension())
        } else {
            out.clone()
        };
        // Outputs that cannot be written are refused before the work.
        let beside = vectors_beside(&path)?;
        let parts = [Part::beside(&path)?, Part::beside(&beside)?];
        let exported = moment_shadows::export(&encoding, self.target)?;
        let vectors = lines(&exported.vectors()?)?;
        let [text, file] = parts;
        let text = text.write(|file| file.write_all(exported.text.as_bytes()))?;
        let file = file.write(|file| file.write_all(vectors.as_bytes()))?;
        text.keep()?;
        file.keep()?;
        Ok(ExitCode::SUCCESS)
    }
}

/// `NAME.vectors.json` beside `NAME.hlsl`.
fn vectors_beside(path: &Path) -> Result<PathBuf, CommandError> {
    let beside = path.with_extension("vectors.json");
    if path.extension() == Some(OsStr::new("json")) {
        return Err(CommandError::Write {
            path: path.display().to_string(),
            reason: "vectors are written beside it as JSON; name it by its language".to_owned(),
        });
    }
    Ok(beside)
}

/// The vectors as JSON, with a row on each line.
fn lines(vectors: &Vectors) -> Result<String, CommandError> {
    let text = serde_json::to_string(vectors)?;
    Ok(text
        .replace("{\"inputs\"", "\n{\"inputs\"")
        .replace("{\"name\"", "\n{\"name\"")
        + "\n")
}
