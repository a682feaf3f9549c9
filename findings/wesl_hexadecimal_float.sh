#!/usr/bin/env bash
# wesl 0.6.0 (Rust crate; 0.4.0 too): the exponent of a hexadecimal float counts as a power of 16.
#
# Behaviour seen: `const a: f32 = 0x1p-24;` is written out as 1.262177448353619e-29, which is 16^-24. By WGSL ("Floating Point Literals") the
# exponent after `p` is one of 2: 5.9604645e-8. `0x1.8p1` becomes 24, not 3. No error, no warning: the shader compiles with other numbers.
# A good guess: the exponent is parsed with base 2, as in C.
# Who meets it: authors of shaders that write exact floats (masks of the mantissa, units in the last place), Bevy's included, which links by
# this crate.
# Output seen (2026-11-29): 0x1p-24 -> 1.262177448353619e-29, 0x1.8p1 -> 24.0.
#
# Run by hand: findings/wesl_hexadecimal_float.sh. Needs cargo. Exits with 0 as long as this is so, with 1 if it has changed.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/src"
cat > "$folder/Cargo.toml" <<'TOML'
[package]
name = "hexadecimal"
version = "0.0.0"
edition = "2024"

[workspace]

[dependencies]
wesl = "=0.6.0"
TOML
cat > "$folder/src/main.rs" <<'RUST'
use wesl::Compiler;
use wesl::resolver::VirtualResolver;

/// The number of the constant, as it is linked.
fn linked(literal: &str) -> f32 {
    let mut resolver = VirtualResolver::new();
    let text = format!("const a: f32 = {literal};\n");
    resolver.add_module("package::main".parse().expect("a path"), text.into());
    let mut compiler = Compiler::default().with_resolver(resolver);
    compiler.options.keep_main = true;
    let linked = compiler.compile("main.wgsl").expect("the shader is linked").to_string();
    println!("{literal} -> {}", linked.trim());
    let number = linked.split(['=', ';']).nth(1).expect("a number");
    number.trim().trim_end_matches('f').parse().expect("a number")
}

fn main() {
    let as_found = linked("0x1p-24") == 16f32.powi(-24) && linked("0x1.8p1") == 24.0;
    println!("{}", if as_found { "as found" } else { "this has changed" });
    std::process::exit(i32::from(!as_found));
}
RUST
# The crate asks for Rust 1.97.1 and is built by 1.95.
cargo run --quiet --ignore-rust-version --manifest-path "$folder/Cargo.toml"
