//! The modules through linkers of WESL, the language of our imports: what they make of each module and of the example of forward
//! shading is valid, and all constants and functions have the same bits on the adapter as through our linker. The Rust crate runs
//! with all tests, npm's package in `./run check`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod adapter;
mod judge;
mod npm;
mod package;
mod roots;
mod rust;
mod values;
