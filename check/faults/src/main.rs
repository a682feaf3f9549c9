//! Lets every call of Vulkan that a session makes fail once, in turn: `cargo run --release -p moment-shadows-faults`.
//!
//! Each has to end in an error value or in nothing at all: no panic, no hang, nothing for the host's own handler, and no object
//! of the driver left once session and device are dropped. A session that refuses other textures has to be as before.

mod host;
mod panicked;
mod steer;
mod story;
mod tried;
mod watch;

use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::{env, fs};

use clap::Parser;
use steer::Steer;
use story::CHAPTERS;
use tried::Tried;

/// Lets each call of Vulkan fail once that a session makes: without memory, and with a lost device.
#[derive(Parser)]
struct Options {
    /// Only one of so many calls
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// The number of the first call
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// The manifest of the driver that does the work; Mesa's llvmpipe of the system without this
    #[arg(long)]
    driver: Option<PathBuf>,
}

/// What tells this program that its driver is in place.
const IN_PLACE: &str = "FAULTS_LIBRARY";

fn main() -> ExitCode {
    let options = Options::parse();
    let done = match env::var_os(IN_PLACE) {
        Some(library) => every_call(Path::new(&library), &options),
        None => with_driver(&options),
    };
    match done {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

type Error = Box<dyn std::error::Error>;

/// Runs this program again, with the driver of this package before the other one. Whether it found nothing.
fn with_driver(options: &Options) -> Result<bool, Error> {
    let manifest = options.driver.clone().map_or_else(llvmpipe, Ok)?;
    let text = fs::read_to_string(&manifest)
        .map_err(|error| format!("{}: {error}", manifest.display()))?;
    let said: serde_json::Value = serde_json::from_str(&text)?;
    let said = said["ICD"]["library_path"].as_str();
    let said = said.ok_or_else(|| format!("{} names no library", manifest.display()))?;
    // A path without a folder is looked for by the system; others are relative to the manifest.
    let folder = manifest.parent().unwrap_or(Path::new("."));
    let other = if said.contains('/') {
        folder.join(said)
    } else {
        PathBuf::from(said)
    };
    let program = env::current_exe()?;
    // Where cargo puts libraries of programs that it builds.
    let library = program.with_file_name("deps").join(format!(
        "{}moment_shadows_faults{}",
        env::consts::DLL_PREFIX,
        env::consts::DLL_SUFFIX
    ));
    let folder = tempfile::tempdir()?;
    let own = folder.path().join("faults.json");
    let json = serde_json::json!({
        "file_format_version": "1.0.0",
        "ICD": { "library_path": library, "api_version": "1.3.0" },
    });
    fs::write(&own, json.to_string())?;
    let status = Command::new(program)
        .args(env::args_os().skip(1))
        .env(IN_PLACE, library)
        .env("FAULTS_DRIVER", other)
        .env("VK_DRIVER_FILES", &own)
        .env("VK_ICD_FILENAMES", &own)
        .status()?;
    Ok(status.success())
}

/// The manifest of llvmpipe.
fn llvmpipe() -> Result<PathBuf, Error> {
    const FOLDERS: [&str; 2] = ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"];
    for folder in FOLDERS {
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            if name.starts_with("lvp_icd") {
                return Ok(path);
            }
        }
    }
    Err("there is no llvmpipe; name the manifest of a driver by --driver".into())
}

/// Lets each call fail. Whether nothing was found.
fn every_call(library: &Path, options: &Options) -> Result<bool, Error> {
    let steer = Steer::open(library)?;
    panicked::listen();
    let mut found = false;
    for chapter in &CHAPTERS {
        let tried = Tried::every(&steer, chapter, options.first, options.every)?;
        print!("{tried}");
        found |= tried.found();
    }
    Ok(!found)
}
