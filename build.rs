//! Lists the modules of `wgsl/`: a file there is a module of the library without being named anywhere else.

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

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo::rerun-if-changed=wgsl");
    let root = PathBuf::from(env::var("CARGO_MANIFEST_DIR")?).join("wgsl");
    let mut list = String::from("&[\n");
    for folder in entries(&root)?.iter().filter(|path| path.is_dir()) {
        for file in entries(folder)? {
            let names = [folder.file_name(), file.file_stem()];
            let [Some(folder), Some(name)] = names.map(|name| name.and_then(|name| name.to_str()))
            else {
                return Err(format!("{} is not named in Unicode", file.display()).into());
            };
            writeln!(
                list,
                "Module {{ folder: {folder:?}, name: {name:?}, source: include_str!({file:?}) }},"
            )?;
        }
    }
    list.push(']');
    fs::write(Path::new(&env::var("OUT_DIR")?).join("modules.rs"), list)?;
    Ok(())
}
