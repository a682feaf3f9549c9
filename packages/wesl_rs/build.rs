//! Packages the modules of `moment-shadows` for the crate `wesl`.

use std::error::Error;

use moment_shadows::modules;
use wesl::package::{Package, PackageModule};

/// What begins a declaration. In the library's modules each one begins a line.
const DECLARATIONS: [&str; 4] = ["fn ", "struct ", "alias ", "const "];

/// The text with each declaration marked as public: `wesl` imports no others from a package. In WGSL that is no word, so the library's
/// modules are without.
fn with_public(source: &str) -> String {
    let mut text = String::new();
    for line in source.lines() {
        if DECLARATIONS.iter().any(|start| line.starts_with(start)) {
            text += "public ";
        }
        text += line;
        text.push('\n');
    }
    text
}

/// The library's folders, each with its modules.
fn folders() -> Vec<PackageModule> {
    let mut folders: Vec<PackageModule> = Vec::new();
    for module in modules() {
        let index = folders.iter().position(|it| it.name == module.folder);
        let index = index.unwrap_or_else(|| {
            folders.push(packaged(module.folder, String::new()));
            folders.len() - 1
        });
        let packaged = packaged(module.name, with_public(module.source));
        folders[index].submodules.push(packaged);
    }
    folders
}

fn packaged(name: &str, source: String) -> PackageModule {
    PackageModule {
        name: name.to_owned(),
        source,
        submodules: Vec::new(),
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut root = packaged("moment_shadows", String::new());
    root.submodules = folders();
    let package = Package {
        crate_name: env!("CARGO_PKG_NAME").replace('-', "_"),
        root,
        dependencies: Vec::new(),
    };
    package.validate()?.build_artifact()?;
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
