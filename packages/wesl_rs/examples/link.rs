//! Links shaders that import the library's modules: `cargo run --example link -- FILE...`
//!
//! `package::` is the folder of each file. What is linked is written beside it, as `NAME.linked`.

use std::error::Error;
use std::path::PathBuf;
use std::process::ExitCode;

use wesl::Compiler;

fn link(file: &PathBuf) -> Result<(), Box<dyn Error>> {
    let mut compiler = Compiler::default();
    let package = &moment_shadows_wesl::PACKAGE;
    compiler.options.dependencies.push(package);
    let linked = compiler.compile(file)?;
    std::fs::write(file.with_extension("linked"), linked.to_string())?;
    Ok(())
}

fn main() -> ExitCode {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    if files.is_empty() {
        eprintln!("usage: cargo run --example link -- FILE...");
        return ExitCode::from(2);
    }
    let mut refused = 0;
    for file in &files {
        if let Err(error) = link(file) {
            eprintln!("{}: {error}", file.display());
            refused += 1;
        }
    }
    println!(
        "wesl-rs: {} shaders linked, {refused} refused",
        files.len() - refused
    );
    ExitCode::from(u8::from(refused > 0))
}
