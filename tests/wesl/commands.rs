//! Linkers that are run as commands, each with the package of the library that is made for it.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use moment_shadows::modules;

use crate::judge::judge;
use crate::roots::{Place, roots, spread_imports};

/// Writes every root below `folder`, for a user who has the package and for one who has copied the modules; lets the command link
/// each to a file `NAME.linked` beside it, and judges these.
fn judge_command(command: impl FnOnce(&Path) -> Command) {
    let folder = tempfile::tempdir().unwrap();
    for place in Place::ALL {
        fs::create_dir(folder.path().join(place.name())).unwrap();
        for root in roots() {
            let file = format!("{}/{}.wgsl", place.name(), root.name);
            fs::write(folder.path().join(file), root.text(place)).unwrap();
        }
    }
    for module in modules() {
        let within = format!("{}/shadows/{}", Place::Copied.name(), module.folder);
        let within = folder.path().join(within);
        fs::create_dir_all(&within).unwrap();
        let file = within.join(format!("{}.wgsl", module.name));
        fs::write(file, spread_imports(module.source)).unwrap();
    }
    let status = command(folder.path()).status().unwrap();
    assert!(status.success(), "{status}");
    judge(|root, place| {
        let file = format!("{}/{}.linked", place.name(), root.name);
        fs::read_to_string(folder.path().join(file)).map_err(|error| error.to_string())
    });
}

/// A path of the repository.
fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
#[ignore = "needs node, the packages of check/package.json and the package of packages/npm: ./run check"]
fn the_npm_package_links_every_module_to_the_same_bits() {
    judge_command(|folder| {
        let mut command = Command::new("node");
        command.arg(repository("check/wesl.mjs")).arg(folder);
        command
    });
}

#[test]
#[ignore = "builds packages/wesl_rs, with dependencies of its own: ./run check"]
fn the_rust_package_links_every_module_to_the_same_bits() {
    judge_command(|folder| {
        let mut command = Command::new(env!("CARGO"));
        // Without optimisation: it takes longer to compile than to link.
        command.args(["run", "--locked", "--quiet", "--example", "link"]);
        // The crate `wesl` asks for a newer Rust than it needs.
        command.arg("--ignore-rust-version");
        let manifest = repository("packages/wesl_rs/Cargo.toml");
        command.arg("--manifest-path").arg(manifest);
        let target = concat!(env!("CARGO_TARGET_TMPDIR"), "/wesl_rs");
        command.args(["--target-dir", target, "--"]);
        for place in Place::ALL {
            for root in roots() {
                command.arg(folder.join(format!("{}/{}.wgsl", place.name(), root.name)));
            }
        }
        command
    });
}
