//! `wgsl/wesl.toml`, with which tools of WESL take the folder as a package, and the packages that are made of it.

use std::collections::BTreeMap;
use std::path::Path;

use moment_shadows::modules;
use wesl::PkgBuilder;

#[test]
fn the_package_holds_every_module() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("wgsl");
    let package = PkgBuilder::new("moment-shadows").scan_toml(folder).unwrap();
    assert_eq!(package.root.name, "moment_shadows");
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

#[test]
fn the_package_for_the_crate_has_the_version_of_the_library() {
    // That of the npm package is read from the manifest of the library.
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("packages/wesl_rs/Cargo.toml");
    let text = std::fs::read_to_string(manifest).unwrap();
    let version = env!("CARGO_PKG_VERSION");
    for line in [
        format!("\nversion = \"{version}\"\n"),
        format!("moment-shadows = {{ version = \"{version}\","),
    ] {
        assert!(
            text.contains(&line),
            "packages/wesl_rs/Cargo.toml lacks {line:?}"
        );
    }
}
