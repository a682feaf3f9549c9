//! `wgsl/wesl.toml`, with which tools of WESL take the folder as a package.

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
