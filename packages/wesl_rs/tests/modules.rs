//! Every module of the library in the crate `wesl`. Results on a device are compared by `tests/wesl` of the repository.
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

use std::collections::BTreeMap;

use moment_shadows::{Module, modules};
use moment_shadows_wesl::PACKAGE;
use wesl::package::PackageBuilder;
use wesl::resolver::VirtualResolver;
use wesl::syntax::ModulePath;
use wesl::{CompileOptions, compile};

/// The names of a module's declarations, which begin lines.
fn items(module: &Module) -> Vec<&'static str> {
    let name = |line: &'static str| {
        let (kind, rest) = line.split_once(' ')?;
        let end = |c: char| !c.is_alphanumeric() && c != '_';
        let known = ["fn", "struct", "alias", "const"].contains(&kind);
        rest.split(end).next().filter(|_| known)
    };
    module.source.lines().filter_map(name).collect()
}

#[test]
fn the_package_holds_every_module_with_all_of_it_public() {
    let mut found = BTreeMap::new();
    for folder in PACKAGE.root.submodules {
        for module in folder.submodules {
            found.insert((folder.name, module.name), module.source);
        }
    }
    assert_eq!(PACKAGE.root.name, "moment_shadows");
    assert_eq!(found.len(), modules().len());
    for module in modules() {
        let text = found[&(module.folder, module.name)];
        assert_eq!(text.replace("\npublic ", "\n"), module.source);
        let public = text.lines().filter(|line| line.starts_with("public "));
        assert_eq!(public.count(), items(module).len(), "{}", module.name);
    }
}

/// The modules as Bevy 0.20 has them, where each one is a shader of its own and visibility is off.
#[test]
fn modules_link_as_they_are_where_visibility_is_off() {
    let path = |path: &str| path.parse::<ModulePath>().unwrap();
    let options = CompileOptions {
        visibility: false,
        ..CompileOptions::default()
    };
    for module in modules() {
        let mut resolver = VirtualResolver::new();
        for Module {
            folder,
            name,
            source,
        } in modules()
        {
            let at = path(&format!("moment_shadows::{folder}::{name}"));
            resolver.add_module(at, (*source).into());
        }
        let (folder, name, items) = (module.folder, module.name, items(module));
        // Names are all that the linker looks at.
        let uses: String = items
            .iter()
            .map(|item| format!("    _ = {item};\n"))
            .collect();
        let names = items.join(", ");
        let main = format!(
            "import moment_shadows::{folder}::{name}::{{{names}}};\n\
             @compute @workgroup_size(1) fn main() {{\n{uses}}}\n"
        );
        resolver.add_module(path("package::main"), main.into());
        let linked = compile(&path("package::main"), &options, &resolver);
        let linked = linked.unwrap_or_else(|error| panic!("{name}: {error}"));
        let linked = linked.to_string();
        for item in items {
            // Where it is used, and where it is declared.
            assert!(linked.matches(item).count() >= 2, "{name}: {item}");
        }
    }
}

/// `wgsl/` is a package by itself, for projects that add the folder.
#[test]
fn the_folder_is_a_package_with_every_module() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../wgsl");
    let package = PackageBuilder::new("moment-shadows").scan_toml(folder).unwrap();
    let mut found = BTreeMap::new();
    for folder in &package.root.submodules {
        for module in &folder.submodules {
            let path = (folder.name.as_str(), module.name.as_str());
            found.insert(path, module.source.as_str());
        }
    }
    let registered = modules().iter().map(|it| ((it.folder, it.name), it.source));
    assert_eq!(found, registered.collect());
}
