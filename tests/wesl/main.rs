//! The modules through linkers of WESL, the language of our imports: what they make of each module is valid, and gives the
//! same bits on the adapter as what our linker makes of it. The Rust crate runs with all tests, npm's package in `./run check`.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod judge;
mod npm;
mod package;
mod roots;
mod rust;
mod values;
