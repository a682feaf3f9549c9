//! The bounded, seeded run: `cargo run --release -p moment-shadows-fuzz -- --seconds 60 --seed 1`.

use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::time::Duration;
use std::{env, fs, io};

use clap::Parser;
use moment_shadows_fuzz::runner::{Run, watch, work};
use moment_shadows_fuzz::{TARGETS, Target};

/// Tries out seeded mutations of graph files, plans, glTF files and shaders. Fails at the first panic, abort, hang, file left
/// behind, or boundless use of memory, and writes the input that did it to a file.
#[derive(Parser)]
struct Options {
    /// A target; all of them without this
    #[arg(long, value_parser = TARGETS.map(|target| target.name))]
    target: Option<String>,
    /// For how long, over all targets
    #[arg(long, default_value_t = 60)]
    seconds: u64,
    /// The seed of the mutations
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// The first input
    #[arg(long, default_value_t = 0)]
    first: u64,
    /// How many inputs of each target at most
    #[arg(long, default_value_t = u64::MAX)]
    iterations: u64,
    /// Further inputs to start from, for one target
    #[arg(long, requires = "target", num_args = 1..)]
    seeds: Vec<PathBuf>,
    /// Writes the first input to this file instead of trying it out
    #[arg(long, requires = "target")]
    write: Option<PathBuf>,
    /// Tries this file out instead
    #[arg(long, requires = "target", conflicts_with = "write")]
    input: Option<PathBuf>,
    #[arg(long, hide = true)]
    work: bool,
}

fn main() -> ExitCode {
    let options = Options::parse();
    match run(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Whether nothing was found.
fn run(options: &Options) -> io::Result<bool> {
    let chosen: Vec<&Target> = TARGETS
        .into_iter()
        .filter(|target| {
            options
                .target
                .as_ref()
                .is_none_or(|name| name == target.name)
        })
        .collect();
    let run = Run {
        seed: options.seed,
        first: options.first,
        iterations: options.iterations,
        time: Duration::from_secs(options.seconds) / chosen.len() as u32,
    };
    let mut found = false;
    for target in chosen {
        let mut seeds = (target.seeds)();
        for path in &options.seeds {
            seeds.push(fs::read(path)?);
        }
        if let Some(path) = &options.input {
            let is_valid = (target.try_out)(&fs::read(path)?);
            println!("it is {}", if is_valid { "valid" } else { "refused" });
        } else if let Some(path) = &options.write {
            fs::write(path, target.input(&seeds, run.seed, run.first))?;
        } else if options.work {
            work(target, &seeds, &run)?;
        } else {
            found |= watched(target, &seeds, &run, options)?;
        }
    }
    Ok(!found)
}

/// Runs a target in a process of its own, and says what it gave.
fn watched(target: &Target, seeds: &[Vec<u8>], run: &Run, options: &Options) -> io::Result<bool> {
    let mut command = Command::new(env::current_exe()?);
    command.args(["--work", "--target", target.name]);
    let numbers = [
        ("--seed", run.seed),
        ("--first", run.first),
        ("--iterations", run.iterations),
        ("--seconds", run.time.as_secs()),
    ];
    for (flag, number) in numbers {
        command.args([flag, &number.to_string()]);
    }
    if !options.seeds.is_empty() {
        command.arg("--seeds");
        for path in &options.seeds {
            command.arg(fs::canonicalize(path)?);
        }
    }
    let summary = watch(command)?;
    println!(
        "{:<12} {:>8} inputs, {} of them valid; the slowest took {:.2} s (number {})",
        target.name,
        summary.inputs,
        summary.valid,
        summary.slowest.as_secs_f64(),
        summary.slowest_input
    );
    let Some((input, what)) = summary.finding else {
        return Ok(false);
    };
    let path = env::current_dir()?.join(format!("finding-{}-{}-{input}", target.name, run.seed));
    fs::write(&path, target.input(seeds, run.seed, input))?;
    eprintln!(
        "{}: input {input} of seed {}: {what}",
        target.name, run.seed
    );
    eprintln!("it was written to {}; try it out with", path.display());
    eprintln!(
        "  cargo run --release -p moment-shadows-fuzz -- --target {} --input {}",
        target.name,
        path.display()
    );
    Ok(true)
}
