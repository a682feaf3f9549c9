//! Reads `wgsl/`: a file there is a module of the library without being named anywhere else, whose items are known, and a number that
//! stands there is a constant of the same name here.

use std::error::Error;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// What `folder` holds, in order.
fn entries(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut paths: Vec<_> = fs::read_dir(folder)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<_, _>>()?;
    paths.sort();
    Ok(paths)
}

/// The constants of a module that are numbers, and the numbers of those that are made of several: of `Bias(TARGET, 1e-4)` it is
/// `[1e-4]`.
fn constants(text: &str) -> String {
    let is_number = |text: &&str| text.parse::<f64>().is_ok();
    let constant = |declaration: &str| {
        let (name, rest) = declaration.split_once(':')?;
        let (of, value) = rest.split_once(';')?.0.split_once('=')?;
        let (of, value) = (of.trim(), value.trim().trim_end_matches(['u', 'i', 'f']));
        if is_number(&value) {
            return Some(format!("pub(crate) const {name}: {of} = {value};\n"));
        }
        let parts = value.split_once('(')?.1.strip_suffix(')')?;
        let parts = parts.split(['(', ')', ',']);
        let numbers: Vec<_> = parts.map(str::trim).filter(is_number).collect();
        let (count, numbers) = (numbers.len(), numbers.join(", "));
        Some(format!(
            "pub(crate) const {name}: [f32; {count}] = [{numbers}];\n"
        ))
    };
    text.split("\nconst ")
        .skip(1)
        .filter_map(constant)
        .collect()
}

/// The names that a module defines.
fn items(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let (keyword, rest) = line.split_once(' ')?;
        let defines = matches!(keyword, "alias" | "const" | "fn" | "struct");
        let end = |c: char| !c.is_alphanumeric() && c != '_';
        rest.split(end).next().filter(|_| defines)
    })
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=wgsl");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("wgsl");
    let mut modules = String::from("const MODULES: &[Module] = &[\n");
    let mut defined = String::from("pub(crate) const ITEMS: &[(&str, &str)] = &[\n");
    let mut numbers = String::new();
    for folder in entries(&root)?.iter().filter(|path| path.is_dir()) {
        for file in entries(folder)? {
            let names = [folder.file_name(), file.file_stem()];
            let [Some(folder), Some(name)] = names.map(|name| name.and_then(|name| name.to_str()))
            else {
                return Err(format!("{} is not named in Unicode", file.display()).into());
            };
            writeln!(
                modules,
                "Module {{ folder: {folder:?}, name: {name:?}, source: include_str!({file:?}) }},"
            )?;
            let text = fs::read_to_string(&file)?;
            numbers += &constants(&text);
            for item in items(&text) {
                writeln!(defined, "(\"{folder}::{name}\", {item:?}),")?;
            }
        }
    }
    let out = PathBuf::from(env::var("OUT_DIR")?);
    fs::write(out.join("modules.rs"), modules + "];\n" + &defined + "];\n")?;
    fs::write(out.join("constants.rs"), numbers)?;
    Ok(())
}
