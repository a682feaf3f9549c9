#!/usr/bin/env bash
# wesl 0.4.0 (Rust crate, feature `package`): the key of wesl.toml that its documentation names is ignored without a word.
#
# Behaviour seen: the documentation of `WeslToml` writes `package-manager = "npm"`; the parser reads `package_manager` only and denies no
# unknown key, so the documented spelling leaves the package manager at its default, "cargo". The other spelling works.
# A good guess: the documented key is read, or refused as unknown.
# Who meets it: authors of WESL packages for npm who write the manifest by the documentation.
# Output seen (2026-11-29): package-manager -> "cargo", package_manager -> "npm".
#
# Run by hand: findings/wesl_manifest_key.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "manifest"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
serde_json = "=1.0.154"
wesl = { version = "=0.4.0", default-features = false, features = ["package"] }
TOML
cat > "$folder/src/main.rs" <<'RUST'
use wesl::WeslToml;

fn read(key: &str) -> String {
    let text = format!("edition = \"2026_pre\"\n{key} = \"npm\"\nroot = \".\"\n");
    let config = WeslToml::parse_str(&text).expect("the manifest is read");
    let value = serde_json::to_value(&config).expect("the manifest is data");
    value["package_manager"].as_str().unwrap_or("missing").to_owned()
}

fn main() {
    let (documented, read_by_parser) = (read("package-manager"), read("package_manager"));
    println!("package-manager -> {documented:?}, package_manager -> {read_by_parser:?}");
    let as_found = documented == "cargo" && read_by_parser == "npm";
    println!("{}", if as_found { "as found" } else { "this has changed" });
    std::process::exit(i32::from(!as_found));
}
RUST
cargo run --quiet --manifest-path "$folder/Cargo.toml"
