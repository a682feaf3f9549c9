//! The package that is made of the modules for the crate `wesl`.

use std::path::Path;

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
